// The plan's look-ups against a search of all boxes, and the solid without them.
#include "engine/solids/box_solid.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"

namespace run_boxes_test {

using namespace lamella;

namespace {

constexpr SurveyGrid grid{{-1.0, -2.0}, 0.125, 0.5, 0.0625};

std::vector<PlacedRun> random_runs(std::mt19937& random, int count) {
    std::uniform_int_distribution<int> layer(-2, 40), row(-1, 30), begin(-300, 8000), length(1, 900);
    std::vector<PlacedRun> runs;
    for (int i = 0; i < count; ++i) {
        const int b = begin(random);
        runs.push_back({layer(random), row(random), b, b + length(random)});
    }
    return runs;
}

bool holds(const Box& box, dvec3 p) {
    return box.lo.x <= p.x && p.x < box.hi.x && box.lo.y <= p.y && p.y < box.hi.y && box.lo.z <= p.z &&
           p.z < box.hi.z;
}

}  // namespace

TEST_CASE("a box is as long as its run, as wide as its row and as high as its layer") {
    const Box box = grid.box({3, 2, 256, 512});
    REQUIRE(box.lo == dvec3(-0.875, -1.75, 0.6875));
    REQUIRE(box.hi == dvec3(-0.75, -1.625, 0.75));
}

TEST_CASE("runs that overlap or touch in a row become one") {
    const RunBoxes plan(grid, {{0, 0, 10, 20}, {0, 1, 0, 5}, {0, 0, 0, 10}, {0, 0, 15, 18}, {1, 0, 0, 5}});
    const std::vector<PlacedRun> expected{{0, 0, 0, 20}, {0, 1, 0, 5}, {1, 0, 0, 5}};
    REQUIRE(std::vector<PlacedRun>(plan.runs().begin(), plan.runs().end()) == expected);
    REQUIRE(plan.at(0.51).size() == 2);
    REQUIRE(plan.at(0.57).size() == 1);
    REQUIRE(plan.at(0.49).empty());
    REQUIRE(plan.at(0.63).empty());
    REQUIRE(plan.at(-infinity).empty());
    REQUIRE(plan.at(infinity).empty());
}

TEST_CASE("look-ups agree with a search of all boxes") {
    const unsigned seed = 6;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(-1.3, 3.2), y(-2.2, 2), z(0.2, 3.2), reach(0.01, 2),
        size(0.001, 0.8);
    int inside = 0, met = 0;
    for (const int count : {0, 1, 40, 600}) {
        const auto runs = random_runs(random, count);
        const RunBoxes plan(grid, runs);
        REQUIRE(plan.empty() == (count == 0));
        for (int k = 0; k < 2000; ++k) {
            const dvec3 p(x(random), y(random), z(random));
            const double limit = reach(random);
            const Box probe{p, p + dvec3(size(random), size(random), size(random))};
            bool held = false, meets = false;
            double nearest = limit;
            for (const PlacedRun& run : runs) {
                const Box box = grid.box(run);
                held = held || holds(box, p);
                meets = meets || !intersect(box, probe).empty();
                nearest = std::min(nearest, distance(box, p));
            }
            INFO(count << " runs, point " << p.x << " " << p.y << " " << p.z << ", limit " << limit);
            REQUIRE((plan.find(p) != nullptr) == held);
            REQUIRE(plan.distance_within(p, limit) == Approx(nearest).margin(1e-12));
            REQUIRE(plan.meets(probe) == meets);
            inside += held ? 1 : 0;
            met += meets ? 1 : 0;
        }
    }
    REQUIRE(inside > 20);
    REQUIRE(met > 500);
    const RunBoxes plan(grid, random_runs(random, 40));
    REQUIRE(std::isfinite(plan.distance_within({0, 0, 0}, infinity)));
    REQUIRE(plan.find({NAN, 0, 1}) == nullptr);
    REQUIRE_FALSE(plan.meets({}));
}

TEST_CASE("rows and columns lose exactly the boxes, in either direction") {
    const unsigned seed = 7;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto plan = std::make_shared<RunBoxes>(grid, random_runs(random, 900));
    const FieldPtr solid = make_box({{-0.9, -1.9, 0.4}, {2.9, 1.9, 3.1}});
    const FieldPtr rest = make_without_boxes(solid, plan);
    REQUIRE(rest->bounds().lo == solid->bounds().lo);
    for (const double z : {0.53, 1.2, 2.41, 3.05}) {
        for (const Axis axis : {Axis::x, Axis::y}) {
            for (const double sign : {1.0, -1.0}) {
                const RowBand band{axis,        sign > 0 ? -2.0 : 4.0,
                                   sign * 0.05, sign > 0 ? -3.0 : 4.0,
                                   sign * 0.03, 5,
                                   200,         3,
                                   0,           120};
                SliceContext context;
                Scratch scratch;
                RunRows rows;
                context.slice(*rest, z).runs(band, scratch, rows);
                REQUIRE(rows.lines() == 600);
                bool lost = false;
                for (int l = 0; l < band.lines(); ++l) {
                    const auto runs = rows.line(static_cast<std::size_t>(l));
                    for (int u = 3; u < band.hi * run_unit; u += 61) {
                        const double along = band.along(u + 0.5), across = band.line(l);
                        const dvec3 p = axis == Axis::x ? dvec3(along, across, z) : dvec3(across, along, z);
                        bool in = false;
                        for (const Run& run : runs) in = in || (run.begin <= u && u < run.end);
                        const double v = rest->value(p);
                        if (std::abs(v) < 4e-4) continue;
                        INFO("line " << l << ", unit " << u << ", value " << v);
                        REQUIRE(in == (v < 0));
                        lost = lost || (!in && solid->value(p) < 0);
                    }
                }
                REQUIRE(lost);
            }
        }
    }
}

TEST_CASE("the value never exceeds the distance to the surface that is left") {
    const unsigned seed = 8;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto plan = std::make_shared<RunBoxes>(grid, random_runs(random, 500));
    const FieldPtr solid = make_sphere({0.5, 0, 1.5}, 1.3);
    const FieldPtr rest = make_without_boxes(solid, plan);
    REQUIRE(rest->metric() == Metric::bound);
    std::uniform_real_distribution<double> at(-1.5, 1.5), step(-1, 1);
    for (int k = 0; k < 3000; ++k) {
        const dvec3 p = dvec3(0.5, 0, 1.5) + dvec3(at(random), at(random), at(random));
        const double v = rest->value(p);
        // Within |v| of the point, all is on the same side.
        for (int i = 0; i < 20; ++i) {
            const dvec3 d(step(random), step(random), step(random));
            const dvec3 q = p + d * (std::abs(v) * 0.999 / std::max(1e-9, glm::length(d)));
            REQUIRE((rest->value(q) < 0) == (v < 0));
        }
    }
}

TEST_CASE("a solid of boxes is solid exactly in them, and is no nearer than it says") {
    const unsigned seed = 9;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto runs = random_runs(random, 300);
    const auto plan = std::make_shared<RunBoxes>(grid, runs);
    const FieldPtr solid = make_box_solid(plan);
    std::uniform_real_distribution<double> x(-1.3, 3.2), y(-2.2, 2), z(0.2, 3.2), size(0.01, 0.5);
    int inside = 0;
    Box all;
    for (const PlacedRun& run : runs) all = unite(all, grid.box(run));
    REQUIRE(solid->bounds().lo == all.lo);
    REQUIRE(solid->bounds().hi == all.hi);
    for (int k = 0; k < 3000; ++k) {
        const dvec3 p(x(random), y(random), z(random));
        bool held = false;
        double nearest = infinity;
        for (const PlacedRun& run : runs) {
            held = held || holds(grid.box(run), p);
            nearest = std::min(nearest, distance(grid.box(run), p));
        }
        const double v = solid->value(p);
        REQUIRE((v < 0) == held);
        if (!held) REQUIRE(v == Approx(nearest).margin(1e-12));
        inside += held ? 1 : 0;
        const Box probe{p, p + dvec3(size(random), size(random), size(random))};
        const Interval range = solid->range(probe);
        REQUIRE(range.contains(v));
        REQUIRE(range.contains(solid->value(probe.center())));
    }
    REQUIRE(inside > 20);
    const FieldPtr none = make_box_solid(std::make_shared<RunBoxes>(grid, std::vector<PlacedRun>{}));
    REQUIRE(none->bounds().empty());
    REQUIRE(none->value({0, 0, 1}) > 0);
    REQUIRE_THROWS_AS(make_box_solid(nullptr), InputError);
}

TEST_CASE("without boxes to take, the solid is itself") {
    const FieldPtr sphere = make_sphere({0, 0, 0}, 1);
    const auto plan = std::make_shared<RunBoxes>(grid, std::vector<PlacedRun>{});
    const FieldPtr same = make_without_boxes(sphere, plan);
    SliceContext context;
    REQUIRE(&context.slice(*same, 0.2) == &context.slice(*sphere, 0.2));
    REQUIRE(same->value({0.3, 0, 0}) == sphere->value({0.3, 0, 0}));
    REQUIRE(same->range({{-2, -2, -2}, {2, 2, 2}}).hi == sphere->range({{-2, -2, -2}, {2, 2, 2}}).hi);
    REQUIRE_THROWS_AS(make_without_boxes(nullptr, plan), InputError);
    REQUIRE_THROWS_AS(make_without_boxes(sphere, nullptr), InputError);
}

}  // namespace run_boxes_test
