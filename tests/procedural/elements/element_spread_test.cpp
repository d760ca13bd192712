// Spread elements against counts by halves, distances, ways, and areas by closed forms.
#include "procedural/elements/element_spread.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/solids/primitives.h"
#include "procedural/texture/body_sites.h"

namespace element_spread_test {

using namespace lamella;

namespace {

/// A plate 60 x 40 in squares of 0.5 mm.
SpreadSites plate_sites() {
    SpreadSites sites{.spacing = 0.5, .is_flat = true};
    for (int y = 0; y < 80; ++y) {
        for (int x = 0; x < 120; ++x) sites.places.emplace_back(0.5 * x + 0.25 - 30, 0.5 * y + 0.25 - 20, 0);
    }
    sites.sizes.assign(sites.size(), 1);
    sites.densities.assign(sites.size(), 1);
    return sites;
}

SpreadSites ball_sites(double radius, double spacing) {
    SurfaceSites surface = sites_on_surface(*make_sphere(dvec3(0), radius), spacing, 1'000'000, nullptr);
    set_tangents(surface, nullptr, dvec3(0, 0, 1), 1);
    SpreadSites sites{.spacing = spacing, .places = surface.places, .normals = surface.normals};
    sites.ways = surface.tangents;
    for (const dvec3 n : sites.normals)
        sites.sizes.push_back(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}));
    sites.densities.assign(sites.size(), 1);
    return sites;
}

double least_distance(const std::vector<PlacedElement>& elements) {
    double least = infinity;
    for (std::size_t a = 0; a < elements.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) least = std::min(least, length(elements[a].at - elements[b].at));
    }
    return least;
}

}  // namespace

TEST_CASE("spread elements keep their distance", "[elements]") {
    const std::vector<ElementShapePtr> discs{make_outline({{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}, 1)};
    const SpreadSites plate = plate_sites();
    const auto on_plate = spread_elements(plate, discs, {.count = 150});
    REQUIRE(on_plate.size() == 150);
    // Of the densest packing, hexagons, whose middles are this far apart.
    const double densest = std::sqrt(2 / std::sqrt(3.0) * 60 * 40 / 150);
    CHECK(least_distance(on_plate) > 0.65 * densest);
    const auto on_ball = spread_elements(ball_sites(20, 0.8), discs, {.count = 150});
    const double densest_on_ball = std::sqrt(2 / std::sqrt(3.0) * 4 * std::numbers::pi * 20 * 20 / 150);
    CHECK(least_distance(on_ball) > 0.65 * densest_on_ball);
    for (const PlacedElement& element : on_ball) {
        CHECK(length(element.at) == Approx(20).margin(0.01));
        CHECK(glm::dot(element.turn * dvec3(0, 0, 1), element.at) == Approx(20).margin(0.01));
    }
}

TEST_CASE("as many elements are spread as densities say", "[elements]") {
    const std::vector<ElementShapePtr> sticks{make_stick(2, 1)};
    SpreadSites plate = plate_sites();
    for (std::size_t i = 0; i < plate.size(); ++i) plate.densities[i] = plate.places[i].x < 0 ? 1 : 3;
    const auto right_of = [](const std::vector<PlacedElement>& elements, double x) {
        return static_cast<double>(
            std::ranges::count_if(elements, [x](const PlacedElement& e) { return e.at.x > x; }));
    };
    CHECK(right_of(spread_elements(plate, sticks, {.count = 400}), 0) == Approx(300).margin(10));
    // On a ball: a zone's area goes by its height, whatever way the lattice of the sites lies.
    const auto on_ball = spread_elements(ball_sites(20, 0.8), sticks, {.count = 400});
    CHECK(right_of(on_ball, 10) == Approx(100).margin(10));
    for (const dvec3 way : {dvec3(1, 1, 1), dvec3(-1, 1, 1)}) {
        const auto above = std::ranges::count_if(
            on_ball, [way](const PlacedElement& e) { return glm::dot(e.at, way) / length(way) > 10; });
        CHECK(static_cast<double>(above) == Approx(100).margin(10));
    }
    // In space, in cubes of 1 mm.
    SpreadSites box{.spacing = 1};
    for (int z = 0; z < 20; ++z) {
        for (int y = 0; y < 20; ++y) {
            for (int x = 0; x < 40; ++x) box.places.emplace_back(x - 19.5, y + 0.5, z + 0.5);
        }
    }
    box.sizes.assign(box.size(), 1);
    for (const dvec3 p : box.places) box.densities.push_back(p.x < 0 ? 0.5 : 2);
    CHECK(right_of(spread_elements(box, sticks, {.count = 500}), 0) == Approx(400).margin(16));
    for (double& density : box.densities) density = 0;
    CHECK_THROWS_AS(spread_elements(box, sticks, {.count = 500}), InputError);
}

TEST_CASE("spread elements lie along their ways, the same on any number of threads", "[elements]") {
    const std::vector<ElementShapePtr> shapes{make_stick(8, 1), make_ring(4, 1)};
    SpreadSites plate = plate_sites();
    for (const dvec3 p : plate.places) plate.ways.push_back(glm::normalize(dvec3(-p.y - 0.01, p.x, 0)));
    const SpreadSettings settings{.count = 60, .scale = {0.5, 1.5}, .is_aligned = true};
    const auto spread = spread_elements(plate, shapes, settings);
    for (const PlacedElement& element : spread) {
        const dvec3 along = element.turn * dvec3(1, 0, 0);
        CHECK(std::abs(glm::dot(along, dvec3(dvec2(element.at), 0))) < 0.5);  // along circles
        CHECK(element.scale >= 0.5);
        CHECK(element.scale <= 1.5);
    }
    CHECK(std::ranges::count_if(spread, [](const PlacedElement& e) { return e.shape == 1; }) > 15);
    for (const int threads : {1, 3}) {
        ThreadArena arena(threads);
        CHECK(arena.execute([&] { return spread_elements(plate, shapes, settings); }) == spread);
    }
    // Long ones leave each other room at their ends: fewer of them overlap than of the same at random.
    const std::vector<ElementShapePtr> sticks{make_stick(8, 1)};
    const auto share = [&](const SpreadSettings& with) {
        return cover_of(plate, spread_elements(plate, sticks, with), sticks).overlap;
    };
    CHECK(share({.count = 120, .is_aligned = true}) < 0.5 * share({.count = 120}));
}

TEST_CASE("what elements cover is measured", "[elements]") {
    const SpreadSites plate = plate_sites();
    // Two squares of 10 mm that share a quarter of each.
    const std::vector<ElementShapePtr> squares{make_outline({{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}}, 1)};
    const SpreadCover cover =
        cover_of(plate, std::vector<PlacedElement>{{.at = {0, 0, 0}}, {.at = {5, 5, 0}}}, squares);
    CHECK(cover.share == Approx(175.0 / 2400));
    CHECK(cover.overlap == Approx(25.0 / 200));
}

}  // namespace element_spread_test
