// Slopes of formulas against difference quotients, and the runs that they help to find against exhaustive
// sampling.
#include "engine/formula/formula_slope.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "engine/field/slice_context.h"
#include "engine/formula/formula_field.h"
#include "engine/formula/formula_parser.h"
#include "tests/engine/formula/formula_samples.h"

namespace formula_slope_test {

using namespace lamella;

namespace {

const std::vector<std::string> names{"x", "y", "z"};

/// The slope along x of a formula over a box.
SlopeBound slope_along_x(const Formula& formula, std::span<const FormulaRange> inputs) {
    FormulaStack stack(formula);
    stack.enter(inputs);
    FormulaSlopes slopes;
    return slopes.bound(stack.tape(), stack.ranges(), 0, inputs[0].values.hi - inputs[0].values.lo);
}

SlopeBound slope_of(const std::string& text, double lo, double hi) {
    const FormulaRange inputs[3] = {{{lo, hi}, false}, {{1, 2}, false}, {{0, 0}, false}};
    return slope_along_x(parse_formula(text, names), inputs);
}

RowBand band_of(Axis axis, int first, int count) {
    RowBand band;
    band.axis = axis;
    band.along_origin = -3.03;
    band.across_origin = 3.1;
    band.along_pitch = 0.11;
    band.across_pitch = -0.13;
    band.first = first;
    band.count = count;
    band.hi = 55;
    return band;
}

/// Whether the run's end at u is where the solid's sign turns: in the quarter pitch around it, and at the
/// very 1/16 of a unit where there is but one.
bool turns_at(const std::function<bool(double)>& inside, std::int32_t u) {
    const int quarter = run_unit / 4;
    for (const int begin : {(u - 1) / quarter * quarter, u / quarter * quarter}) {
        std::vector<int> cells;
        for (int cell = 0; cell < 16 * quarter; ++cell)
            if (inside(begin + cell / 16.0) != inside(begin + (cell + 1) / 16.0)) cells.push_back(cell);
        if (inside(begin) == inside(begin + quarter)) continue;
        if (cells.size() > 1 || round_run(begin + (cells[0] + 0.5) / 16) == u) return true;
    }
    return false;
}

}  // namespace

TEST_CASE("slopes enclose the difference quotients of random formulas") {
    std::mt19937 random(5);
    std::size_t known = 0;
    for (int k = 0; k < 20000; ++k) {
        const Formula formula = k % 4 == 0 ? samples::random_formula(random, 3, 3 + k % 14)
                                           : samples::tame_formula(random, 2 + k % 9);
        std::uniform_real_distribution<double> at(-4, 4), size(0.001, 0.5), share(0, 1);
        FormulaRange inputs[3];
        for (FormulaRange& input : inputs) {
            const double lo = at(random);
            input = {{lo, lo + size(random)}, false};
        }
        const SlopeBound bound = slope_along_x(formula, inputs);
        if (!bound.known()) continue;
        known += !bound.flat();
        for (int i = 0; i < 10; ++i) {
            double p[3];
            for (int j = 0; j < 3; ++j) {
                const Interval& range = inputs[j].values;
                p[j] = std::min(range.lo + share(random) * (range.hi - range.lo), range.hi);
            }
            const Interval& along = inputs[0].values;
            double q[3] = {along.lo + share(random) * (along.hi - along.lo), p[1], p[2]};
            if (i % 2 == 1) q[0] = std::min(p[0] + 1e-12 * share(random), along.hi);
            if (q[0] < p[0]) std::swap(q[0], p[0]);
            const double rise = formula.at(q) - formula.at(p), run = q[0] - p[0];
            INFO("formula " << k << ": " << rise << " over " << run << ", slope " << bound.slope.lo << " to "
                            << bound.slope.hi << ", noise " << bound.noise);
            REQUIRE(rise >= bound.slope.lo * run - bound.noise);
            REQUIRE(rise <= bound.slope.hi * run + bound.noise);
        }
    }
    REQUIRE(known > 1000);
}

TEST_CASE("slopes are those of the calculus") {
    const auto is = [](const SlopeBound& bound, double lo, double hi) {
        return bound.noise < 1e-12 && std::abs(bound.slope.lo - lo) < 1e-9 &&
               std::abs(bound.slope.hi - hi) < 1e-9;
    };
    REQUIRE(is(slope_of("3*x - y", 0, 1), 3, 3));
    REQUIRE(is(slope_of("-x + sqrt(y)", 0, 1), -1, -1));
    REQUIRE(is(slope_of("sqrt(x)", 4, 9), 1.0 / 6, 1.0 / 4));
    REQUIRE(is(slope_of("x*y", 0, 1), 1, 2));
    REQUIRE(is(slope_of("1/x", 1, 2), -1, -0.25));
    REQUIRE(is(slope_of("y/x", 1, 2), -2, -0.25));
    REQUIRE(is(slope_of("sin(x)", 0.25, 1), std::cos(1.0), std::cos(0.25)));
    REQUIRE(is(slope_of("cos(x)", 0.25, 1), -std::sin(1.0), -std::sin(0.25)));
    REQUIRE(is(slope_of("exp(x)", 0, 1), 1, std::exp(1.0)));
    REQUIRE(is(slope_of("ln(x)", 1, 2), 0.5, 1));
    REQUIRE(is(slope_of("atan(x)", 1, 2), 0.2, 0.5));
    REQUIRE(is(slope_of("abs(x)", -1, 2), -1, 1));
    REQUIRE(is(slope_of("max(2*x, 5*x - 1)", 0, 1), 2, 5));
    REQUIRE(is(slope_of("min(x, 9 + y)", 0, 1), 1, 1));
    REQUIRE_FALSE(slope_of("floor(x)", 0.5, 1.5).known());
    REQUIRE_FALSE(slope_of("sqrt(x)", 0, 1).known());
    REQUIRE_FALSE(slope_of("1/x", -1, 1).known());
}

TEST_CASE("rounding that a slope does not show is in its noise") {
    // The sum is rounded to multiples of 0.125, though its slope is that of x.
    const SlopeBound bound = slope_of("(x + 1e15) - 1e15", 0, 1);
    REQUIRE(bound.noise >= 0.125);
    REQUIRE_FALSE(bound.one_way(0.01));
    REQUIRE(slope_of("x", 0, 1).one_way(1e-9));
}

TEST_CASE("runs of formulas are those of sampling every quarter, however they are cut into bands") {
    for (const std::string text :
         {"sin(3*x)*cos(2*y) + sin(y)*cos(z) + cos(3*x)*sin(z)", "max(hypot(x, y) - 2, 0.7 - hypot(x-1, y))",
          "min(hypot(x-1, y, z) - 1, abs(x+y) - 0.02, max(abs(x+1), abs(y-1)) - 0.5)",
          "sin(70*x + 3*y)*sin(67*y) - 0.3", "(x + 3e13) - 3e13 - sin(y)", "x*x*x - x + 0.2*y",
          "max(mod(x, 1) - 0.5, y - floor(2*x))", "sqrt(x) - 1 - 0.1*y",
          "-min(1 - x*x, max(y, -0.5 - x*y))"}) {
        INFO(text);
        const FieldPtr field = make_formula_field(parse_formula(text, names), {}, {dvec3(-2.5), dvec3(2.5)});
        SliceContext context;
        Scratch scratch;
        const double z = 0.21;
        const SliceField& slice = context.slice(*field, z);
        for (const Axis axis : {Axis::x, Axis::y}) {
            const int rows = 48;
            const RowBand whole = band_of(axis, 0, rows);
            RunRows all, part;
            slice.runs(whole, scratch, all);
            REQUIRE(all.total_length() > 0);
            for (const int height : {1, 5, 16}) {
                for (int first = 0; first < rows; first += height) {
                    const int count = std::min(height, rows - first);
                    slice.runs(band_of(axis, first, count), scratch, part);
                    for (int l = 0; l < count; ++l) {
                        const auto a = all.line(static_cast<std::size_t>(first + l));
                        const auto b = part.line(static_cast<std::size_t>(l));
                        REQUIRE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
                    }
                }
            }
            for (int l = 0; l < rows; ++l) {
                const auto inside = [&](double u) {
                    const double along = whole.along(u), across = whole.line(l);
                    return field->value(axis == Axis::x ? dvec3(along, across, z) : dvec3(across, along, z)) <
                           0;
                };
                std::size_t ends = 0, turns = 0;
                for (const Run& run : all.line(static_cast<std::size_t>(l))) {
                    for (const std::int32_t u : {run.begin, run.end}) {
                        const bool border = u == 0 || u == whole.hi * run_unit;
                        REQUIRE((border || turns_at(inside, u)));
                        ends += !border;
                    }
                }
                for (int u = 0; u < whole.hi * run_unit; u += run_unit / 4)
                    turns += inside(u) != inside(u + run_unit / 4);
                REQUIRE(ends == turns);
            }
        }
    }
}

}  // namespace formula_slope_test
