// Fuzz target: any bytes, read as an SVG drawing, end in finite polygons or in an InputError.
#include <cstdint>
#include <cstdlib>

#include "engine/base/error.h"
#include "engine/io/svg_outline.h"
#include "tests/fuzz/scratch_file.h"

using namespace lamella;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string path = scratch_file("fuzz.svg", data, size);
    try {
        for (const auto& polygon : read_svg_outlines(path, 0.01)) {
            if (polygon.size() < 3) std::abort();
        }
    } catch (const InputError&) {
    }
    return 0;
}
