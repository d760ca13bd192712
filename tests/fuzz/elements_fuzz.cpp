// Fuzz target: any bytes, read as a plan of elements, end in a field that has a value or in an InputError.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "engine/base/error.h"
#include "procedural/elements/element_field.h"
#include "procedural/elements/element_plan.h"

using namespace lamella;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream in("lamella elements 4\n" + std::string(reinterpret_cast<const char*>(data), size));
    try {
        ElementPlan plan = read_element_plan(in, "fuzz.elements");
        const FieldPtr field =
            make_element_field({make_stick(4, 1), make_ring(5, 1)}, std::move(plan.elements));
        if (std::isnan(field->value(dvec3(0.5, -1, 2)))) std::abort();
    } catch (const InputError&) {
    }
    return 0;
}
