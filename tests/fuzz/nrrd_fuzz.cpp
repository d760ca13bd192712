// Fuzz target: any bytes, read as an NRRD file, end in a volume whose range encloses its numbers or in an
// InputError.
#include <cstdint>
#include <sstream>

#include "engine/base/error.h"
#include "procedural/volume/volume_grading.h"
#include "tests/fuzz/check_grading.h"

using namespace lamella;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    try {
        Volume volume = read_nrrd(in, "fuzz.nrrd", "/no/such/folder");
        const Box box = volume.box.value_or(Box{{-1, 0, 1}, {2, 4, 9}});
        check_grading(*make_volume_grading(std::move(volume), box), box);
    } catch (const InputError&) {
    }
    return 0;
}
