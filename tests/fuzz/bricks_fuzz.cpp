// Fuzz target: any bytes, read as a file of density bricks, end in bricks whose range encloses their numbers,
// or in an InputError.
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "engine/base/error.h"
#include "procedural/volume/brick_file.h"
#include "procedural/volume/volume_grading.h"
#include "tests/fuzz/check_grading.h"
#include "tests/fuzz/packed_file.h"

using namespace lamella;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream in(packed_file("lamella bricks1", data, size));
    try {
        const auto bricks = std::make_shared<const DensityBricks>(read_bricks(in, "fuzz.bricks"));
        check_grading(*make_volume_grading(bricks), bricks->box());
    } catch (const InputError&) {
    }
    return 0;
}
