// Parts side by side on a plate: none overlap, each is what it is alone, and one alone stays where it is.
#include "engine/layers/plate.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"

namespace plate_test {

using namespace lamella;

namespace {

Job job_of(FieldPtr part, double layer_height = 0.5) {
    Job job;
    job.bounds = part->bounds();
    job.part = std::move(part);
    job.layers = equal_layers(job.bounds.size().z, layer_height);
    job.identity = "job";
    return job;
}

Job box(dvec3 lo, dvec3 size, double layer_height = 0.5) {
    return job_of(make_box({lo, lo + size}), layer_height);
}

/// The one plate of these parts.
Job plate_of(const std::vector<PlateItem>& items, double gap, dvec2 machine) {
    PlateOptions options;
    options.gap = gap;
    options.machine = machine;
    std::vector<Job> plates = arrange_plates(items, options);
    REQUIRE(plates.size() == 1);
    return plates.front();
}

/// Area of a layer by its contours, mm^2.
double area_of(const Job& job, int layer) {
    const Layer cut(job, layer);
    double area = 0;
    for (const Contour& contour : cut.contours(0.01)) area += signed_area(contour.points);
    return area;
}

/// The least distance of two outer contours of the lowest layer, at their vertices; mm.
double least_gap(const Job& job) {
    const Layer cut(job, 0);
    const std::vector<Contour> contours = cut.contours(0.01);
    double least = 1e9;
    for (const Contour& a : contours) {
        for (const Contour& b : contours) {
            if (&a == &b) continue;
            for (const dvec2& p : a.points) {
                for (std::size_t i = 0; i < b.points.size(); ++i) {
                    const dvec2 q = b.points[i], along = b.points[(i + 1) % b.points.size()] - q;
                    const double share =
                        std::clamp(glm::dot(p - q, along) / glm::dot(along, along), 0.0, 1.0);
                    least = std::min(least, glm::distance(p, q + share * along));
                }
            }
        }
    }
    return least;
}

}  // namespace

TEST_CASE("a part alone keeps its place and its identity", "[plate]") {
    const Job alone = box({3, 4, 5}, {2, 2, 2});
    const Job plate = plate_of({{alone, 1}}, 5, {100, 100});
    CHECK(plate.part == alone.part);
    CHECK(plate.identity == alone.identity);
    CHECK(plate.bounds.lo == alone.bounds.lo);
}

TEST_CASE("copies stand in rows with gaps, and none overlap", "[plate]") {
    const Job plate = plate_of({{box({3, 4, 5}, {10, 5, 2}), 7}}, 2, {infinity, infinity});
    // Two rows of four would be 46 mm long, three of three 34 x 19 mm, four of two 22 x 26 mm: the squarest.
    CHECK(plate.bounds.lo == dvec3(3, 4, 5));
    CHECK(plate.bounds.size().x == Approx(22));
    CHECK(plate.bounds.size().y == Approx(4 * 5 + 3 * 2));
    CHECK(plate.layers.count() == 4);
    for (const int layer : {0, 3}) CHECK(area_of(plate, layer) == Approx(7 * 50).epsilon(1e-4));
    int inside = 0;
    for (int copy = 0; copy < 8; ++copy) {
        const dvec3 middle(3 + 5 + 12 * (copy % 2), 4 + 2.5 + 7 * (copy / 2), 6);
        inside += plate.part->value(middle) < 0 ? 1 : 0;
    }
    CHECK(inside == 7);
}

TEST_CASE("rows are as long as it takes to fit the machine", "[plate]") {
    const std::vector<PlateItem> bars{{box({0, 0, 0}, {10, 1, 1}), 4}};
    const auto size_on = [&](dvec2 machine) { return dvec2(plate_of(bars, 1, machine).bounds.size()); };
    CHECK(size_on({21, 3}) == dvec2(21, 3));
    CHECK(size_on({43, 1}) == dvec2(43, 1));
    CHECK(size_on({10, 7}) == dvec2(10, 7));
    CHECK_THROWS_WITH(size_on({5, 100}), Catch::Contains("10.00 x 1.00 mm"));
}

TEST_CASE("parts of several heights stand on one bed, with their supports", "[plate]") {
    Job tall = box({0, 0, -3}, {4, 4, 10});
    tall.supports = make_box({{0, 0, -3}, {1, 1, -2}});
    const Job low = box({50, 50, 20}, {6, 3, 1});
    const Job plate = plate_of({{tall, 1}, {low, 2}}, 1, {infinity, infinity});
    CHECK(plate.z0() == -3);
    CHECK(plate.layers.count() == 20);
    CHECK(area_of(plate, 0) == Approx(16 + 2 * 18).epsilon(1e-4));
    CHECK(area_of(plate, 2) == Approx(16).epsilon(1e-4));
    CHECK(plate.supports);
    CHECK(plate.identity != tall.identity);
}

TEST_CASE("parts that rows have no room for are nested, on as many plates as it takes", "[plate]") {
    // Corners of 20 mm with arms of 5 mm: three nest on 30 x 30 mm, of which boxes would take one.
    const Job corner =
        job_of(make_union({make_box({{0, 0, 0}, {20, 5, 2}}), make_box({{0, 0, 0}, {5, 20, 2}})}));
    const Job tile = box({-3, -3, 0}, {6, 6, 1});
    PlateOptions options;
    options.gap = 1;
    options.machine = {32, 32};
    options.turns = GENERATE(false, true);
    options.threads = GENERATE(1, 4);
    const std::vector<PlateItem> items{{corner, 4}, {tile, 5}};
    const std::vector<Job> plates = arrange_plates(items, options);
    CHECK(plates.size() <= 2);
    double corners = 0, all = 0;
    for (const Job& plate : plates) {
        CHECK(plate.bounds.size().x <= 32 * (1 + 1e-9));
        CHECK(plate.bounds.size().y <= 32 * (1 + 1e-9));
        all += area_of(plate, 0);
        corners += area_of(plate, plate.layers.count() - 1);
        CHECK(least_gap(plate) >= 1);
    }
    CHECK(all == Approx(4 * (20 * 5 + 15 * 5) + 5 * 36).epsilon(1e-3));
    CHECK(corners == Approx(4 * (20 * 5 + 15 * 5)).epsilon(1e-3));
    // The same again, whatever the threads.
    options.threads = 2;
    const std::vector<Job> again = arrange_plates(items, options);
    REQUIRE(again.size() == plates.size());
    for (std::size_t i = 0; i < plates.size(); ++i) {
        CHECK(again[i].bounds.lo == plates[i].bounds.lo);
        CHECK(again[i].identity == plates[i].identity);
    }
    options.machine = {19, 32};
    CHECK_THROWS_WITH(arrange_plates(items, options), Catch::Contains("20.00 x 20.00 mm"));
}

TEST_CASE("plates that make no sense are refused", "[plate]") {
    CHECK_THROWS_AS(arrange_plates({}, {}), InputError);
    const std::vector<PlateItem> mixed{{box({0, 0, 0}, {1, 1, 1}, 0.5), 1},
                                       {box({0, 0, 0}, {1, 1, 1}, 0.25), 1}};
    CHECK_THROWS_WITH(arrange_plates(mixed, {}), Catch::Contains("0.25") && Catch::Contains("0.5"));
}

}  // namespace plate_test
