// Fuzz target: any text, read as a formula and as a flat program, ends in numbers within their enclosures or
// in an InputError.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "engine/base/error.h"
#include "engine/formula/formula_parser.h"
#include "engine/formula/formula_vm.h"

using namespace lamella;

namespace {

const std::array<std::string, 3> names{"x", "y", "z"};

void check(const Formula& formula) {
    const std::array<FormulaRange, 3> box{{{{-2, 3}, false}, {{0, 0}, false}, {{-1e9, 1e-9}, false}}};
    const FormulaRange range = lamella::range(formula, box);
    const std::array<std::array<double, 3>, 3> points{{{-2, 0, -1e9}, {3, 0, 1e-9}, {0.5, 0, 0}}};
    for (const auto& point : points) {
        const double number = formula.at(point);
        if (std::isnan(number) ? !range.maybe_nan : !range.values.contains(number)) std::abort();
    }
}

template <typename Read>
void try_reading(const Read& read) {
    try {
        const Formula formula = read();
        if (formula.input_count() <= 3) check(formula);
    } catch (const InputError&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    try_reading([&] { return parse_formula(text, names); });
    try_reading([&] { return read_vm(text, "fuzz.vm"); });
    return 0;
}
