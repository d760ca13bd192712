// Fuzz target: any bytes, read as an NRRD file, end in a volume whose range encloses its numbers or in an
// InputError.
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "engine/base/error.h"
#include "procedural/volume/volume_grading.h"

using namespace lamella;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    try {
        Volume volume = read_nrrd(in, "fuzz.nrrd", "/no/such/folder");
        const Box box = volume.box.value_or(Box{{-1, 0, 1}, {2, 4, 9}});
        const GradingPtr grading = make_volume_grading(std::move(volume), box);
        const Interval range = grading->range(box);
        for (const dvec3 p : {box.lo, box.hi, box.center(), box.lo + box.size() * dvec3(0.1, 0.8, 0.3)}) {
            const double number = grading->at(p);
            if (std::isnan(number) ? range.hi != infinity : !range.contains(number)) std::abort();
        }
    } catch (const InputError&) {
    }
    return 0;
}
