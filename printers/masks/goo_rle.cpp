// Chunks of one grey: type, size of the length, length, and the grey if it is neither black nor white.
#include "printers/masks/goo_rle.h"

#include <algorithm>

namespace lamella {
namespace {

constexpr std::uint32_t start_byte = 0x55;
constexpr std::uint64_t longest_run = (std::uint64_t{1} << 28U) - 1;
constexpr std::uint32_t black = 0x00, grey = 0x40, white = 0xc0;  // chunk types

}  // namespace

GooEncoder::GooEncoder() { bytes_.push_back(static_cast<std::byte>(start_byte)); }

void GooEncoder::put(std::uint32_t byte) {
    bytes_.push_back(static_cast<std::byte>(byte & 0xffU));
    sum_ += byte & 0xffU;
}

void GooEncoder::add(std::span<const GreyRun> runs) {
    for (const GreyRun& run : runs) {
        if (run.value != value_) flush();
        value_ = static_cast<std::uint8_t>(run.value);
        length_ += run.length;
    }
}

/// The lowest four bits of the length are in the first byte, the others follow, the highest first.
void GooEncoder::flush() {
    while (length_ > 0) {
        const auto run = static_cast<std::uint32_t>(std::min(length_, longest_run));
        const std::uint32_t more = run < 1U << 4U ? 0 : run < 1U << 12U ? 1 : run < 1U << 20U ? 2 : 3;
        const std::uint32_t type = value_ == 0 ? black : value_ == 255 ? white : grey;
        put(type | more << 4U | (run & 0xfU));
        if (type == grey) put(value_);
        for (std::uint32_t byte = more; byte-- > 0;) put(run >> (4 + 8 * byte));
        length_ -= run;
    }
}

std::vector<std::byte> GooEncoder::finish() {
    flush();
    bytes_.push_back(static_cast<std::byte>(~sum_ & 0xffU));
    return std::move(bytes_);
}

}  // namespace lamella
