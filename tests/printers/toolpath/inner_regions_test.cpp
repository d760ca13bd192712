// What infill goes where: solid near surfaces, bridges over the void, sparse in the core.
#include "printers/toolpath/inner_regions.h"

#include <catch2/catch.hpp>

#include "tests/printers/polygons/hand_made_contours.h"

namespace inner_regions_test {

using namespace lamella;
using namespace lamella::test;
using Fill = InnerRegion::Fill;

namespace {

const LineSettings line{0.45, 0.2, 0.02};

Polygons box(dvec2 lo, dvec2 hi) { return {to_polygon(box_contour(lo, hi).points)}; }
Polygons disc(dvec2 center, double radius) { return {to_polygon(disc_contour(center, radius).points)}; }

double area_of_kind(const std::vector<InnerRegion>& regions, Fill fill) {
    double sum = 0;
    for (const InnerRegion& region : regions) sum += region.fill == fill ? area_of(region.region) : 0;
    return sum;
}

/// The parts do not overlap, and nothing of the region is lost but slivers.
void check_partition(const Polygons& region, const std::vector<InnerRegion>& parts) {
    Polygons all;
    double sum = 0;
    for (const InnerRegion& part : parts) {
        all = unite_polygons(all, part.region);
        sum += area_of(part.region);
        REQUIRE(split_pieces(part.region).size() == 1);
    }
    CHECK(sum == Approx(area_of(all)).epsilon(1e-4));
    CHECK(area_of(subtract_polygons(region, all)) < 0.01 * area_of(region));
    CHECK(area_of(subtract_polygons(all, region)) < 1e-4 * area_of(region));
}

}  // namespace

TEST_CASE("infill is sparse in the core and solid outside of it", "[inner_regions]") {
    const Polygons region = box({0, 0}, {40, 30});
    const PlacedPolygons core(disc({20, 15}, 10));
    const auto parts = divide_inside(region, {nullptr, &core}, 0.2, line);
    check_partition(region, parts);
    const double sparse = area_of_kind(parts, Fill::sparse);
    CHECK(sparse < 3.1416 * 100);
    CHECK(sparse > 3.1416 * 8 * 8);  // solid parts reach over it by a few widths
    for (const InnerRegion& part : parts) {
        if (part.fill == Fill::sparse) CHECK(area_of(subtract_polygons(part.region, core.all())) < 1e-6);
    }
    CHECK(area_of_kind(parts, Fill::bridge) == 0);
    // Without surfaces near all is sparse, at full density all solid.
    CHECK(area_of_kind(divide_inside(region, {}, 0.2, line), Fill::sparse) == Approx(1200));
    CHECK(area_of_kind(divide_inside(region, {nullptr, &core}, 1, line), Fill::solid) == Approx(1200));
    // No core at all: a layer near the bed.
    const PlacedPolygons none;
    CHECK(area_of_kind(divide_inside(region, {nullptr, &none}, 0.2, line), Fill::solid) == Approx(1200));
}

TEST_CASE("sparse specks become solid", "[inner_regions]") {
    const Polygons region = box({0, 0}, {40, 30});
    const PlacedPolygons core(unite_polygons(disc({10, 15}, 2), box({20, 5}, {38, 25})));
    const auto parts = divide_inside(region, {nullptr, &core}, 0.2, line);
    check_partition(region, parts);
    CHECK(std::ranges::count(parts, Fill::sparse, &InnerRegion::fill) == 1);
}

TEST_CASE("what hangs is bridged the short way and anchored on both sides", "[inner_regions]") {
    const double density = GENERATE(0.2, 1.0);
    const Polygons region = box({0, 0}, {40, 30});
    const LayerBelow footing(subtract_polygons(region, box({10, 5}, {18, 25})), 0.1);
    const PlacedPolygons core;
    const auto parts = divide_inside(region, {&footing, &core}, density, line);
    check_partition(region, parts);
    int bridges = 0;
    for (const InnerRegion& part : parts) {
        if (part.fill != Fill::bridge) continue;
        ++bridges;
        CHECK(std::abs(part.along.x) == Approx(1));
        CHECK(extent(part.region, {1, 0}).lo < 9);
        CHECK(extent(part.region, {1, 0}).hi > 19);
        CHECK(area_of(subtract_polygons(box({10, 5}, {18, 25}), part.region)) < 0.02);
    }
    CHECK(bridges == 1);
    // A step out by less than a line is none.
    const LayerBelow almost(box({0.3, 0.3}, {39.7, 29.7}), 0.1);
    CHECK(area_of_kind(divide_inside(region, {&almost, &core}, density, line), Fill::bridge) == 0);
    // Sparse infill bridges nothing.
    CHECK(area_of_kind(divide_inside(region, {&footing, nullptr}, 0.2, line), Fill::bridge) == 0);
}

}  // namespace inner_regions_test
