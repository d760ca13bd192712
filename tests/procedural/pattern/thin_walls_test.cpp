// Thin walls: which sites lie across, and patterns that go through.
#include "procedural/pattern/thin_walls.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "procedural/pattern/surface_pattern.h"
#include "procedural/texture/body_sites.h"

namespace thin_walls_test {

using namespace lamella;

namespace {

SurfaceSites sites_of(const Field& body) {
    SurfaceSites sites = sites_on_surface(body, 0.2, 1'000'000, nullptr);
    set_tangents(sites, nullptr, dvec3(0, 1, 0), 0);
    return sites;
}

FieldPtr plate(double thickness, double side = 10) {
    const dvec3 half = 0.5 * dvec3(side, side, thickness);
    return make_box({-half, half});
}

bool is_amid(dvec3 place) { return std::max(std::abs(place.x), std::abs(place.y)) < 4; }

}  // namespace

TEST_CASE("a site across a thin wall is the one below it", "[texture]") {
    const FieldPtr body = plate(0.7);
    SurfaceSites sites = sites_of(*body);
    set_across(sites, *body, 0.8);
    REQUIRE(sites.across.size() == sites.size());
    int amid = 0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const std::uint32_t other = sites.across[i];
        if (is_amid(sites.places[i])) {
            ++amid;
            REQUIRE(other != SurfaceSites::none);
        }
        if (other == SurfaceSites::none) continue;
        const dvec3 way = sites.places[other] - sites.places[i];
        CHECK(std::abs(way.z) == Approx(0.7).margin(1e-3));
        CHECK(std::hypot(way.x, way.y) < sites.spacing);
    }
    CHECK(amid > 2000);
    set_across(sites, *body, 0.69);
    CHECK(sites.across.empty());
}

TEST_CASE("of two sides of a thin wall, one is the back", "[texture]") {
    // A dish with a floor of 0.7 mm: its inner side is smaller.
    const FieldPtr dish =
        make_difference(make_box({{-5, -5, 0}, {5, 5, 3}}), make_box({{-3, -3, 0.7}, {3, 3, 4}}));
    SurfaceSites sites = sites_of(*dish);
    CHECK(back_sites(sites).empty());
    set_across(sites, *dish, 0.8);
    const std::vector<std::uint32_t> backs = back_sites(sites);
    const bool is_inside = sites.normals[backs.at(0)].z > 0;
    for (const std::uint32_t site : backs) {
        CHECK(std::abs(sites.normals[site].z) == Approx(1));
        CHECK((sites.normals[site].z > 0) == is_inside);
        CHECK(std::max(std::abs(sites.places[site].x), std::abs(sites.places[site].y)) < 3.01);
    }
    CHECK(static_cast<double>(backs.size()) * 0.04 == Approx(36).epsilon(0.15));
    std::vector<float> values;
    for (const dvec3 place : sites.places) values.push_back(static_cast<float>(place.z > 0.5 ? 0 : place.x));
    copy_across(sites, backs, values);
    for (const std::uint32_t site : backs)
        CHECK(values[site] == Approx(is_inside ? sites.places[site].x : 0).margin(1e-5));
}

TEST_CASE("both sides of a thin wall are solid where one is", "[texture]") {
    const FieldPtr body = plate(0.7);
    SurfaceSites sites = sites_of(*body);
    set_across(sites, *body, 0.8);
    const auto disc = [](dvec3 place) {
        return static_cast<float>(3 - std::hypot(place.x - 0.3, place.y + 0.2));
    };
    std::vector<float> values;
    for (const dvec3 place : sites.places) values.push_back(place.z > 0 ? disc(place) : -1);
    share_across(sites, values);
    for (std::size_t i = 0; i < sites.size(); ++i) {
        if (!is_amid(sites.places[i])) continue;
        const float exact = std::max(disc(sites.places[i]), -1.0F);
        // Below, the plane at the nearest site is as good as the circle is flat.
        if (sites.places[i].z > 0)
            CHECK(values[i] == exact);
        else
            CHECK(values[i] == Approx(exact).margin(exact > -1 && exact < 2 ? 0.02 : 0.25));
    }
}

TEST_CASE("the holes of a pattern go through a thin wall", "[texture]") {
    const FieldPtr body = plate(1, 24);
    SurfacePatternSettings settings;
    settings.example.size = 20;
    settings.example.strut = 0.8;
    settings.depth = 1.2;
    const SurfacePattern pattern(synthesise_on_surface(
        read_picture(std::string(LAMELLA_SOURCE_DIR) + "/examples/inputs/blobs.png"), *body, settings));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anywhere(-11, 11);
    constexpr double border = 0.05;  // mm, at which the sides are as good as their samples
    int solid = 0, open = 0;
    for (int i = 0; i < 5000; ++i) {
        const dvec3 above(anywhere(random), anywhere(random), 0.35), below(above.x, above.y, -0.35);
        const double one = pattern.value(above), other = pattern.value(below);
        ++(one < 0 ? solid : open);
        if (std::abs(one) > border && std::abs(other) > border) CHECK((one < 0) == (other < 0));
    }
    CHECK(static_cast<double>(open) / (solid + open) == Approx(1 - pattern.bricks().share).margin(0.03));
}

}  // namespace thin_walls_test
