// Fuzz target: any bytes, read as a file of a surface's pattern, end in a field whose value is a bound of the
// distance, or in an InputError.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "engine/base/error.h"
#include "procedural/pattern/pattern_file.h"
#include "tests/fuzz/packed_file.h"

using namespace lamella;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream in(packed_file("lamella pattern", data, size));
    try {
        const SurfacePattern pattern(read_surface_bricks(in, "fuzz.pattern"));
        const double spacing = pattern.bricks().spacing;
        for (const PatternBrick& brick : pattern.bricks().bricks) {
            const dvec3 p = (dvec3(brick.corner) * 8.0 + dvec3(0.5, 3.5, 7.25)) * spacing;
            if (std::isnan(pattern.value(p))) std::abort();
        }
    } catch (const InputError&) {
    }
    return 0;
}
