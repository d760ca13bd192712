// The chain of a TIFF file's directories.
#include "procedural/tiff_pages.h"

#include <cstdint>
#include <istream>

#include "engine/error.h"

namespace lamella {
namespace {

/// Numbers of a byte order at offsets of a file.
class OrderedBytes {
  public:
    OrderedBytes(std::istream& in, bool big_endian) : in_(in), big_endian_(big_endian) {}

    /// Nothing beyond the end of the file.
    std::optional<std::uint64_t> number(std::uint64_t at, std::size_t bytes) {
        unsigned char raw[8] = {};
        in_.clear();
        if (at > std::uint64_t{1} << 62U || !in_.seekg(static_cast<std::streamoff>(at))) return std::nullopt;
        if (!in_.read(reinterpret_cast<char*>(raw), static_cast<std::streamsize>(bytes))) return std::nullopt;
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < bytes; ++i) value = value << 8U | raw[big_endian_ ? i : bytes - 1 - i];
        return value;
    }

  private:
    std::istream& in_;
    bool big_endian_;
};

}  // namespace

std::optional<std::size_t> count_tiff_pages(std::istream& in, const std::string& name) {
    constexpr std::size_t most_pages = 1000000;
    constexpr std::uint64_t classic = 42, big = 43;
    char order[2] = {};
    if (!in.read(order, 2) || order[0] != order[1] || (order[0] != 'I' && order[0] != 'M'))
        return std::nullopt;
    OrderedBytes bytes(in, order[0] == 'M');
    const auto magic = bytes.number(2, 2);
    const bool wide = magic == big;
    if (!wide && magic != classic) return std::nullopt;
    const std::size_t offset_bytes = wide ? 8 : 4, count_bytes = wide ? 8 : 2, entry_bytes = wide ? 20 : 12;
    auto at = bytes.number(wide ? 8 : 4, offset_bytes);
    std::size_t pages = 0;
    for (; at && *at != 0; ++pages) {
        if (pages == most_pages) throw InputError(name + ": its chain of TIFF pages has no end");
        const auto entries = bytes.number(*at, count_bytes);
        if (!entries || *entries > 0xffffU) at.reset();
        if (at) at = bytes.number(*at + count_bytes + *entries * entry_bytes, offset_bytes);
    }
    if (!at) throw InputError(name + ": the file is cut off: its chain of TIFF pages leads beyond its end");
    return pages;
}

}  // namespace lamella
