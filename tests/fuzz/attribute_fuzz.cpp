// Fuzz target: any bytes, read as a PLY mesh with a number at its vertices, end in a grading whose range
// encloses its numbers or in an InputError.
#include <cstdint>
#include <cstdlib>

#include "engine/base/error.h"
#include "procedural/grading/attribute_grading.h"

using namespace lamella;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        AttributedMesh surface = read_ply_attribute("fuzz.ply", std::as_bytes(std::span(data, size)), "red");
        if (surface.values.size() != surface.mesh.vertices.size()) std::abort();
        const GradingPtr grading = make_attribute_grading(std::move(surface), 2.0);
        const Box box{{-1, 0, 1}, {2, 4, 9}};
        const Interval range = grading->range(box);
        for (const dvec3 p : {box.lo, box.hi, box.center()}) {
            const double number = grading->at(p);
            if (std::isnan(number) ? range.hi != infinity : !range.contains(number)) std::abort();
        }
    } catch (const InputError&) {
    }
    return 0;
}
