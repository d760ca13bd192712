// Fuzz target: any bytes, read as a file of density bricks, end in bricks whose range encloses their numbers,
// or in an InputError.
#include <zlib.h>

#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "procedural/volume/brick_file.h"
#include "procedural/volume/volume_grading.h"
#include "tests/fuzz/check_grading.h"

using namespace lamella;

namespace {

/// The file: of an even first byte the rest as it is, of an odd one packed behind the magic, since bytes that
/// change seldom fit the checksum.
std::string file_of(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return "";
    if (data[0] % 2 == 0) return {reinterpret_cast<const char*>(data) + 1, size - 1};
    uLongf length = compressBound(size - 1);
    std::vector<Bytef> packed(length);
    if (compress2(packed.data(), &length, data + 1, size - 1, 1) != Z_OK) std::abort();
    constexpr char magic[] = "lamella bricks1";
    return std::string(magic, sizeof magic) +
           std::string(packed.begin(), packed.begin() + static_cast<long>(length));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream in(file_of(data, size));
    try {
        const auto bricks = std::make_shared<const DensityBricks>(read_bricks(in, "fuzz.bricks"));
        check_grading(*make_volume_grading(bricks), bricks->box());
    } catch (const InputError&) {
    }
    return 0;
}
