// Fuzz target: any bytes, read as a plan of elements or as an arrangement, end in a field that has a value or
// in an InputError.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "engine/base/error.h"
#include "procedural/elements/element_arrangement.h"
#include "procedural/elements/element_field.h"
#include "procedural/elements/element_plan.h"

using namespace lamella;

namespace {

void use(std::vector<PlacedElement> elements) {
    const FieldPtr field = make_element_field({make_stick(4, 1), make_ring(5, 1)}, std::move(elements));
    if (std::isnan(field->value(dvec3(0.5, -1, 2)))) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    try {
        std::istringstream in("lamella elements 4\n" + text);
        use(read_element_plan(in, "fuzz.elements").elements);
    } catch (const InputError&) {
    }
    try {
        const auto elements = read_arrangement(text, "fuzz.csv", {.shapes = 2, .scales = {0.01, 100}});
        if (std::isnan(spacing_variation(elements))) std::abort();
        use(elements);
    } catch (const InputError&) {
    }
    return 0;
}
