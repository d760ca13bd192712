// Fuzz target: any bytes, read as a PLY mesh with a number at its vertices, end in a grading whose range
// encloses its numbers or in an InputError.
#include <cstdint>
#include <cstdlib>

#include "engine/base/error.h"
#include "procedural/grading/attribute_grading.h"
#include "tests/fuzz/check_grading.h"

using namespace lamella;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        AttributedMesh surface = read_ply_attribute("fuzz.ply", std::as_bytes(std::span(data, size)), "red");
        if (surface.values.size() != surface.mesh.vertices.size()) std::abort();
        check_grading(*make_attribute_grading(std::move(surface), 2.0), {{-1, 0, 1}, {2, 4, 9}});
    } catch (const InputError&) {
    }
    return 0;
}
