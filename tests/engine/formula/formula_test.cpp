// One suite over all operations and random programs: points, batches, intervals and shortened programs agree.
#include "engine/formula/formula.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/base/simd_target.h"
#include "engine/formula/formula_batch.h"
#include "engine/formula/formula_interval.h"
#include "engine/formula/formula_prune.h"
#include "tests/engine/formula/formula_samples.h"

namespace formula_test {

using namespace lamella;
using samples::awkward_number;
using samples::random_formula;
using samples::same_number;

namespace {

/// One operation on inputs 0, 1, 2.
Formula single(FormulaOp op) {
    FormulaBuilder f;
    const auto a = f.input(0), b = f.input(1), c = f.input(2);
    if (arity(op) == 1) return f.finish(f.unary(op, a));
    return f.finish(arity(op) == 2 ? f.binary(op, a, b) : f.select(a, b, c));
}

std::vector<Formula> all_operations() {
    std::vector<Formula> formulas;
    for (int i = 2; i < formula_op_count; ++i) formulas.push_back(single(static_cast<FormulaOp>(i)));
    return formulas;
}

std::vector<Formula> all_operations_and_programs(unsigned seed, int programs) {
    std::vector<Formula> formulas = all_operations();
    std::mt19937 random(seed);
    for (int i = 0; i < programs; ++i) formulas.push_back(random_formula(random, 3, 5 + i % 60));
    return formulas;
}

FormulaTape tape_of(const Formula& f) { return {f.instructions(), f.constants()}; }

/// Compares a batch over lines x points with the points one by one; which input varies how is given by
/// `layout`, two bits an input.
void compare_batch(const Formula& formula, FormulaBatch& batch, std::mt19937& random, int lines, int points,
                   unsigned layout) {
    std::array<std::vector<double>, 3> numbers;
    std::array<BatchInput, 3> inputs;
    for (std::size_t i = 0; i < 3; ++i) {
        const bool by_line = (layout >> (2 * i) & 1) != 0, by_point = (layout >> (2 * i) & 2) != 0;
        numbers[i].resize(static_cast<std::size_t>((by_line ? lines : 1) * (by_point ? points : 1)));
        for (double& v : numbers[i]) v = awkward_number(random);
        inputs[i] = {numbers[i].data(), by_line, by_point};
    }
    std::vector<double> out(static_cast<std::size_t>(lines * points));
    batch.prepare(tape_of(formula));
    batch.run(inputs, lines, points, out);
    for (int l = 0; l < lines; ++l) {
        for (int p = 0; p < points; ++p) {
            double at[3];
            for (std::size_t i = 0; i < 3; ++i) {
                const int line = inputs[i].by_line ? l : 0, point = inputs[i].by_point ? p : 0;
                at[i] =
                    numbers[i][static_cast<std::size_t>(line * (inputs[i].by_point ? points : 1) + point)];
            }
            const double expected = formula.at(at), got = out[static_cast<std::size_t>(l * points + p)];
            INFO("inputs " << at[0] << " " << at[1] << " " << at[2] << ": " << expected << " or " << got);
            REQUIRE(same_number(expected, got));
        }
    }
}

/// A range of inputs, some of them points, infinite or with NaN.
FormulaRange random_range(std::mt19937& random) {
    double a = awkward_number(random), b = awkward_number(random);
    std::uniform_int_distribution<int> kind(0, 7);
    const int k = kind(random);
    if (std::isnan(a)) a = 0;
    if (std::isnan(b)) b = a;
    if (k == 0) b = a;
    if (k == 1) b = a + 1e-3;
    if (k == 7) return {{}, true};
    return {{std::min(a, b), std::max(a, b)}, k == 2};
}

double random_within(const FormulaRange& r, std::mt19937& random) {
    std::uniform_int_distribution<int> kind(0, 9);
    const int k = kind(random);
    if (r.values.empty() || (r.maybe_nan && k == 0)) return NAN;
    if (k == 1) return r.values.lo;
    if (k == 2) return r.values.hi;
    if (k == 3 && r.values.contains(0)) return k % 2 == 0 ? 0.0 : -0.0;
    if (k == 4) {
        const double v = awkward_number(random);
        if (r.values.contains(v)) return v;
    }
    const double lo = std::max(r.values.lo, -1e300), hi = std::min(r.values.hi, 1e300);
    if (!(lo < hi)) return r.values.lo;
    const double t = std::uniform_real_distribution<double>(0, 1)(random);
    return std::min(std::max(lo * (1 - t) + hi * t, r.values.lo), r.values.hi);
}

bool encloses(const FormulaRange& r, double v) { return std::isnan(v) ? r.maybe_nan : r.values.contains(v); }

}  // namespace

TEST_CASE("a batch gives the bits of the point evaluator, on every SIMD target") {
    for (const std::string& target : simd_targets()) {
        INFO(target);
        force_simd_target(target);
        std::mt19937 random(17);
        FormulaBatch batch;
        std::size_t k = 0;
        for (const Formula& formula : all_operations_and_programs(3, 150)) {
            INFO("formula " << k++);
            compare_batch(formula, batch, random, 1, 200, 0b101010);
            compare_batch(formula, batch, random, 7, 13, 0b000110);
            compare_batch(formula, batch, random, 5, 9,
                          std::uniform_int_distribution<unsigned>(0, 63)(random));
        }
    }
    force_simd_target("");
}

TEST_CASE("a range encloses every number, infinite and undefined ones included") {
    std::mt19937 random(23);
    std::size_t k = 0;
    for (const Formula& formula : all_operations_and_programs(4, 300)) {
        const int rounds = k < 40 ? 3000 : 60;
        INFO("formula " << k++);
        for (int round = 0; round < rounds; ++round) {
            const FormulaRange inputs[3] = {random_range(random), random_range(random), random_range(random)};
            const FormulaRange r = range(formula, inputs);
            for (int i = 0; i < 8; ++i) {
                const double at[3] = {random_within(inputs[0], random), random_within(inputs[1], random),
                                      random_within(inputs[2], random)};
                const double v = formula.at(at);
                INFO("inputs " << at[0] << " " << at[1] << " " << at[2] << ": " << v << " in " << r.values.lo
                               << " to " << r.values.hi << (r.maybe_nan ? " or NaN" : ""));
                REQUIRE(encloses(r, v));
            }
        }
    }
}

TEST_CASE("ranges are narrow where the mathematics is") {
    const auto of = [](FormulaOp op, Interval a, Interval b = {0, 0}) {
        const FormulaRange inputs[3] = {{a, false}, {b, false}, {{0, 0}, false}};
        return range(single(op), inputs);
    };
    const auto is = [](const FormulaRange& r, double lo, double hi) {
        return !r.maybe_nan && std::abs(r.values.lo - lo) < 1e-12 && std::abs(r.values.hi - hi) < 1e-12;
    };
    REQUIRE(is(of(FormulaOp::sin, {0, 1.5}), 0, std::sin(1.5)));
    REQUIRE(is(of(FormulaOp::sin, {1, 2}), std::sin(1.0), 1));
    REQUIRE(is(of(FormulaOp::cos, {3, 4}), -1, std::cos(4.0)));
    REQUIRE(is(of(FormulaOp::cos, {0, 7}), -1, 1));
    REQUIRE(is(of(FormulaOp::tan, {-1, 1}), std::tan(-1.0), std::tan(1.0)));
    REQUIRE(is(of(FormulaOp::square, {-2, 1}), 0, 4));
    REQUIRE(is(of(FormulaOp::abs, {-2, 1}), 0, 2));
    REQUIRE(is(of(FormulaOp::mul, {-2, 1}, {3, 5}), -10, 5));
    REQUIRE(is(of(FormulaOp::div, {1, 2}, {4, 8}), 0.125, 0.5));
    REQUIRE(is(of(FormulaOp::mod, {7.25, 7.75}, {2, 2}), 1.25, 1.75));
    REQUIRE(is(of(FormulaOp::exp, {0, 1}), 1, std::exp(1.0)));
    REQUIRE(is(of(FormulaOp::ln, {1, 2}), 0, std::log(2.0)));
    REQUIRE(is(of(FormulaOp::pow, {2, 3}, {0.5, 1.5}), std::sqrt(2.0), std::pow(3.0, 1.5)));
    REQUIRE(is(of(FormulaOp::atan2, {1, 2}, {-1, 1}), std::atan2(1.0, 1.0), std::atan2(1.0, -1.0)));
    REQUIRE(is(of(FormulaOp::less, {1, 2}, {3, 4}), 1, 1));
    REQUIRE(is(of(FormulaOp::compare, {1, 3}, {3, 4}), -1, 0));
    REQUIRE(of(FormulaOp::sqrt, {-2, -1}).values.empty());
    REQUIRE(of(FormulaOp::ln, {-1, 1}).maybe_nan);
}

TEST_CASE("a shortened program gives the bits of the whole one") {
    std::mt19937 random(31);
    std::size_t shorter = 0;
    for (int k = 0; k < 1500; ++k) {
        INFO("formula " << k);
        const Formula formula = random_formula(random, 3, 10 + k % 80);
        FormulaStack stack(formula);
        std::array<FormulaRange, 3> inputs{
            FormulaRange{{-4, 4}, false}, {{-4, 4}, false}, {{-4, 4}, k % 3 == 0}};
        FormulaBatch batch;
        for (int depth = 0; depth < 6; ++depth) {
            stack.enter(inputs);
            const FormulaTape tape = stack.tape();
            shorter += tape.instructions.size() < formula.instructions().size();
            batch.prepare(tape);
            for (int i = 0; i < 10; ++i) {
                double at[3];
                for (std::size_t j = 0; j < 3; ++j) at[j] = random_within(inputs[j], random);
                const BatchInput points[3] = {
                    {&at[0], false, true}, {&at[1], false, true}, {&at[2], false, true}};
                double got = 0;
                batch.run(points, 1, 1, {&got, 1});
                const double expected = formula.at(at);
                INFO("depth " << depth << ", inputs " << at[0] << " " << at[1] << " " << at[2] << ": "
                              << expected << " or " << got);
                REQUIRE(same_number(expected, got));
            }
            FormulaRange& halved = inputs[static_cast<std::size_t>(k + depth) % 3];
            const double middle = (halved.values.lo + halved.values.hi) / 2;
            (random() % 2 == 0 ? halved.values.lo : halved.values.hi) = middle;
        }
        for (int depth = 0; depth < 6; ++depth) stack.leave();
        REQUIRE(stack.tape().instructions.size() == formula.instructions().size());
    }
    REQUIRE(shorter > 500);
}

TEST_CASE("a program shortened for its sign keeps the sign") {
    std::mt19937 random(37);
    std::uniform_real_distribution<double> at(-3, 3);
    const auto sign = [](double v) { return std::isnan(v) ? 2 : v < 0 ? -1 : v > 0 ? 1 : 0; };
    const auto part_of = [](std::mt19937& r) {
        return r() % 4 == 0 ? random_formula(r, 3, 4) : samples::tame_formula(r, 2);
    };
    std::size_t shorter = 0;
    for (int k = 0; k < 3000; ++k) {
        INFO("formula " << k);
        // Random parts, joined by choices and turned about.
        FormulaBuilder f;
        auto node = f.include(part_of(random));
        for (int part = 0; part < 6; ++part) {
            const auto other = f.include(part_of(random));
            const std::uint32_t kind = static_cast<std::uint32_t>(random() % 5);
            if (kind < 4) node = f.binary(kind % 2 == 0 ? FormulaOp::min : FormulaOp::max, node, other);
            if (kind == 4) node = f.select(other, node, f.unary(FormulaOp::neg, node));
            if (random() % 3 == 0) node = f.unary(FormulaOp::neg, node);
        }
        const Formula formula = f.finish(node);
        FormulaStack by_sign(formula, FormulaKeeps::signs), by_number(formula);
        std::array<FormulaRange, 3> inputs;
        for (FormulaRange& input : inputs) {
            const double lo = at(random);
            input = {{lo, lo + 0.5}, false};
        }
        by_sign.enter(inputs);
        by_number.enter(inputs);
        const FormulaTape tape = by_sign.tape();
        shorter += tape.instructions.size() < by_number.tape().instructions.size();
        FormulaBatch batch;
        batch.prepare(tape);
        for (int i = 0; i < 20; ++i) {
            double p[3];
            for (std::size_t j = 0; j < 3; ++j) p[j] = random_within(inputs[j], random);
            const BatchInput points[3] = {{&p[0], false, true}, {&p[1], false, true}, {&p[2], false, true}};
            double got = 0;
            batch.run(points, 1, 1, {&got, 1});
            REQUIRE(sign(got) == sign(formula.at(p)));
        }
    }
    REQUIRE(shorter > 100);
}

TEST_CASE("a union's sign needs no parts that are near but do not touch") {
    FormulaBuilder f;
    const auto x = f.input(0);
    auto nearest = f.binary(FormulaOp::sub, f.unary(FormulaOp::abs, x), f.constant(0.1));
    for (int i = 1; i < 100; ++i) {
        const auto off = f.unary(FormulaOp::abs, f.binary(FormulaOp::sub, x, f.constant(0.3 * i)));
        nearest = f.binary(FormulaOp::min, nearest, f.binary(FormulaOp::sub, off, f.constant(0.1)));
    }
    FormulaStack stack(f.finish(nearest), FormulaKeeps::signs);
    const FormulaRange inputs[1] = {{{2.85, 3.15}, false}};
    stack.enter(inputs);
    REQUIRE(stack.tape().instructions.size() == 6);
}

TEST_CASE("a program of choices shrinks to the one that is near") {
    FormulaBuilder f;
    const auto x = f.input(0);
    auto nearest = f.unary(FormulaOp::abs, x);
    for (int i = 1; i < 100; ++i)
        nearest = f.binary(FormulaOp::min, nearest,
                           f.unary(FormulaOp::abs, f.binary(FormulaOp::sub, x, f.constant(i))));
    const Formula formula = f.finish(nearest);
    FormulaStack stack(formula);
    const FormulaRange inputs[1] = {{{41.9, 42.1}, false}};
    stack.enter(inputs);
    REQUIRE(stack.tape().instructions.size() == 4);
}

TEST_CASE("a formula makes equal parts once and keeps only what it uses") {
    FormulaBuilder f;
    const auto x = f.input(0), y = f.input(1);
    const auto a = f.binary(FormulaOp::add, x, y), b = f.binary(FormulaOp::add, y, x);
    REQUIRE(a == b);
    f.unary(FormulaOp::sin, y);
    const Formula formula = f.finish(f.binary(FormulaOp::mul, a, b));
    REQUIRE(formula.size() == 2);
    REQUIRE(formula.input_count() == 2);
    REQUIRE(formula.reads(1));
    const double at[2] = {3, 4};
    REQUIRE(formula.at(at) == 49);
    FormulaBuilder g;
    g.fix_input(1, 10);
    const Formula fixed = g.finish(g.include(formula));
    REQUIRE_FALSE(fixed.reads(1));
    REQUIRE(fixed.at(at) == 169);
}

}  // namespace formula_test
