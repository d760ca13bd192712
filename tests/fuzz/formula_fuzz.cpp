// Fuzz target: any text, read as a formula and as a flat program, ends in an InputError or in numbers that
// lie within their enclosures and come out alike at one point, in batches and after pruning.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

#include "engine/base/error.h"
#include "engine/formula/formula_batch.h"
#include "engine/formula/formula_field.h"
#include "engine/formula/formula_parser.h"
#include "engine/formula/formula_vm.h"
#include "tests/fuzz/check_runs.h"

using namespace lamella;

namespace {

constexpr std::size_t points = 8;
using Numbers = std::array<double, points>;
using Inputs = std::array<Numbers, 3>;  // of each axis, at each point

const std::array<std::string, 3> names{"x", "y", "z"};

/// A range that begins and ends at numbers where functions turn, jump or overflow.
FormulaRange some_range(std::mt19937& random) {
    constexpr std::array begins{0.0,    -0.0,  1.0, -1.0,  0.5, -2.0, 3.0, 1.57079632679489661,
                                1e-300, -1e-9, 1e9, -1e300};
    constexpr std::array lengths{0.0, 0.0, 1e-12, 0.1, 1.0, 2.0, 6.28318530717958647, 1e6, 1e300};
    const double begin = begins[random() % begins.size()];
    return {{begin, begin + lengths[random() % lengths.size()]}, false};
}

bool same(double a, double b) {
    return std::isnan(a) ? std::isnan(b) : std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_sign(double a, double b) {
    return std::isnan(a) ? std::isnan(b) : (a < 0) == (b < 0) && (a > 0) == (b > 0);
}

Numbers in_batch(const FormulaTape& tape, const Inputs& inputs) {
    FormulaBatch batch;
    batch.prepare(tape);
    std::array<BatchInput, 3> by_point;
    for (std::size_t i = 0; i < 3; ++i) by_point[i] = {inputs[i].data(), false, true};
    Numbers out;
    batch.run(by_point, 1, points, out);
    return out;
}

void check(const Formula& formula, std::mt19937& random) {
    const std::array<FormulaRange, 3> box{some_range(random), some_range(random), some_range(random)};
    Inputs inputs;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Interval& values = box[axis].values;
        for (double& number : inputs[axis]) {
            const double share = static_cast<double>(random() % 5) / 4;
            number = std::clamp(values.lo + share * (values.hi - values.lo), values.lo, values.hi);
        }
    }
    const FormulaRange range = lamella::range(formula, box);
    FormulaStack numbers(formula), signs(formula, FormulaKeeps::signs);
    numbers.enter(box);
    signs.enter(box);
    const Numbers whole = in_batch(FormulaStack(formula).tape(), inputs),
                  shortened = in_batch(numbers.tape(), inputs), signed_only = in_batch(signs.tape(), inputs);
    for (std::size_t i = 0; i < points; ++i) {
        const double number = formula.at(std::array{inputs[0][i], inputs[1][i], inputs[2][i]});
        if (std::isnan(number) ? !range.maybe_nan : !range.values.contains(number)) std::abort();
        if (!same(whole[i], number) || !same(shortened[i], number)) std::abort();
        if (!same_sign(signed_only[i], number)) std::abort();
    }
}

/// Cuts the solid of a formula at some height.
void cut(const Formula& formula, std::mt19937& random) {
    const Box box{dvec3(-2), dvec3(2)};
    const FieldPtr solid = make_formula_field(formula, {}, box);
    constexpr std::array heights{-1.9, 0.0, 0.3};
    SliceContext context;
    Scratch scratch;
    const SliceField& slice = context.slice(*solid, heights[random() % heights.size()]);
    check_runs(slice, {dvec2(-2.5, -2), dvec2(2, 1.5)}, scratch);
}

template <typename Read>
void try_reading(const Read& read, std::mt19937& random) {
    try {
        const Formula formula = read();
        if (formula.input_count() > 3) return;
        for (int box = 0; box < 4; ++box) check(formula, random);
        constexpr std::size_t bearable = 60;  // operations
        if (formula.size() <= bearable) cut(formula, random);
    } catch (const InputError&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    std::uint32_t seed = 2166136261U;  // the same for the same text
    for (const char c : text) seed = (seed ^ static_cast<unsigned char>(c)) * 16777619U;
    std::mt19937 random(seed);
    try_reading([&] { return parse_formula(text, names); }, random);
    try_reading([&] { return read_vm(text, "fuzz.vm"); }, random);
    return 0;
}
