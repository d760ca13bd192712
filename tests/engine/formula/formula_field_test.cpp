// Formula solids against closed forms, their bounds, and gradings made of formulas.
#include "engine/formula/formula_field.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "engine/formula/formula_grading.h"
#include "engine/formula/formula_parser.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"

namespace formula_field_test {

using namespace lamella;

namespace {

const std::vector<std::string> names{"x", "y", "z", "d"};

Formula formula(const std::string& text) { return parse_formula(text, names); }

RowBand band_of(Axis axis, double pitch) {
    RowBand band;
    band.axis = axis;
    band.along_origin = band.across_origin = -6.03;
    band.along_pitch = band.across_pitch = pitch;
    band.count = band.hi = static_cast<int>(12 / pitch);
    return band;
}

/// Runs of both agree to a run unit, but for slivers between neighbouring samples.
void require_same_runs(const FieldPtr& a, const FieldPtr& b) {
    for (const double z : {-1.3, 0.0137, 0.7}) {
        for (const Axis axis : {Axis::x, Axis::y}) {
            const RowBand band = band_of(axis, 0.11);
            SliceContext context;
            Scratch scratch;
            RunRows of_a, of_b, only_a, only_b;
            context.slice(*a, z).runs(band, scratch, of_a);
            context.slice(*b, z).runs(band, scratch, of_b);
            REQUIRE(of_a.total_length() > 0);
            subtract(of_a, of_b, only_a);
            subtract(of_b, of_a, only_b);
            for (const RunRows* rest : {&only_a, &only_b}) {
                std::int64_t slivers = 0;
                for (const Run& run : rest->runs()) {
                    REQUIRE(run.end - run.begin <= run_unit / 4);
                    slivers += run.end - run.begin > 1;
                }
                REQUIRE(slivers <= 4);
            }
        }
    }
}

std::string capsule(dvec3 a, dvec3 b, double r) {
    const dvec3 d = b - a;
    const auto n = [](double v) { return "(" + std::to_string(v) + ")"; };
    const std::string x = "(x-" + n(a.x) + ")", y = "(y-" + n(a.y) + ")", z = "(z-" + n(a.z) + ")";
    const std::string t = "clamp((" + x + "*" + n(d.x) + "+" + y + "*" + n(d.y) + "+" + z + "*" + n(d.z) +
                          ")/" + n(glm::dot(d, d)) + ",0,1)";
    return "length(" + x + "-" + t + "*" + n(d.x) + "," + y + "-" + t + "*" + n(d.y) + "," + z + "-" + t +
           "*" + n(d.z) + ")-" + n(r);
}

}  // namespace

TEST_CASE("formulas of a ball, a torus and capsules have the runs of the closed forms") {
    const Box room{dvec3(-5.5), dvec3(5.5)};
    require_same_runs(make_formula_field(formula("x^2 + (y-1)^2 + z^2 - 9"), {}, room),
                      make_sphere({0, 1, 0}, 3));
    require_same_runs(make_formula_field(formula("hypot(hypot(x, y) - 3, z) - 1.5"), {}, room, Metric::exact),
                      make_torus({0, 0, 0}, 3, 1.5));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> at(-3.5, 3.5);
    std::string text = "min(100";
    std::vector<FieldPtr> parts;
    for (int i = 0; i < 25; ++i) {
        // Six decimals, as the text has them.
        const auto place = [&] { return std::round(at(random) * 1e6) / 1e6; };
        const dvec3 a(place(), place(), place()), b(place(), place(), place());
        text += "," + capsule(a, b, 0.4);
        parts.push_back(make_round_cone({a, 0.4, b, 0.4}));
    }
    require_same_runs(make_formula_field(formula(text + ")"), {}, room), make_union(parts));
}

TEST_CASE("a formula's solid ends at its bounds") {
    const Box room{{-2, -1, -3}, {2, 1.5, 3}};
    const FieldPtr everywhere = make_formula_field(formula("-1"), {}, room);
    SliceContext context;
    Scratch scratch;
    RunRows rows, box;
    const RowBand band = band_of(Axis::x, 0.1);
    context.slice(*everywhere, 0.2).runs(band, scratch, rows);
    context.slice(*make_box(room), 0.2).runs(band, scratch, box);
    REQUIRE(rows == box);
    REQUIRE(everywhere->value({0, 0, 0}) < 0);
    REQUIRE(everywhere->value({0, 1.6, 0}) > 0);
}

TEST_CASE("a formula may read gradings") {
    const GradingPtr depth = make_depth_grading(make_sphere({0, 0, 0}, 4));
    const FieldPtr shell = make_formula_field(formula("abs(d - 1) - 0.5"), {depth}, {dvec3(-4), dvec3(4)});
    const FieldPtr expected = make_difference(make_sphere({0, 0, 0}, 3.5), make_sphere({0, 0, 0}, 2.5));
    require_same_runs(shell, expected);
    REQUIRE_THROWS_AS(make_formula_field(formula("d"), {}, {dvec3(-4), dvec3(4)}), InputError);

    const GradingPtr grading = make_formula_grading(formula("2 * d + x"), {depth});
    REQUIRE(grading->at({1, 0, 0}) == 7);
    const Interval range = grading->range({{0, 0, 0}, {1, 0, 0}});
    REQUIRE(range.lo <= 7);
    REQUIRE(8 <= range.hi);
    REQUIRE(make_formula_grading(formula("sqrt(x)"), {})->range({{-1, 0, 0}, {1, 0, 0}}).hi == infinity);
    REQUIRE_THROWS_AS(make_formula_grading(formula("d"), {}), InputError);
}

TEST_CASE("the bounds of a formula hold its solid closely") {
    const auto bounds = [](const std::string& text) { return formula_bounds(formula(text), {}); };
    const auto close = [](const Box& got, const Box& exact) {
        const double slack = 0.1 * std::max(exact.size().x, std::max(exact.size().y, exact.size().z));
        return got.contains(exact.lo) && got.contains(exact.hi) && grown(exact, slack).contains(got.lo) &&
               grown(exact, slack).contains(got.hi);
    };
    REQUIRE(close(bounds("hypot(x-3, y, z+200) - 5"), {{-2, -5, -205}, {8, 5, -195}}));
    REQUIRE(close(bounds("x^2 + y^2 + z^2 - 4e6"), {dvec3(-2000), dvec3(2000)}));
    REQUIRE(close(bounds("min(hypot(x, y, z) - 0.01, hypot(x-90, y, z) - 0.01)"),
                  {{-0.01, -0.01, -0.01}, {90.01, 0.01, 0.01}}));
    REQUIRE_THROWS_WITH(bounds("hypot(x, y) - 3"), Catch::Contains("not bounded along z"));
    REQUIRE_THROWS_WITH(bounds("x*x + 1"), Catch::Contains("empty"));
    REQUIRE_THROWS_WITH(bounds("ln(-1 - x*x)"), Catch::Contains("empty"));
    REQUIRE_THROWS_AS(bounds("d - 1"), InputError);
}

TEST_CASE("impossible bounds are refused") {
    REQUIRE_THROWS_AS(make_formula_field(formula("x"), {}, {}), InputError);
    REQUIRE_THROWS_AS(make_formula_field(formula("x"), {}, {dvec3(0), dvec3(infinity)}), InputError);
    REQUIRE_THROWS_AS(make_formula_field(formula("x"), {}, {dvec3(0), dvec3(1, 0, 1)}), InputError);
}

}  // namespace formula_field_test
