// Sites and windows on bodies whose surface unrolls, and nearest sites against an exhaustive search.
#include "procedural/texture/body_sites.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "engine/base/error.h"
#include "engine/solids/primitives.h"
#include "procedural/pattern/nearest_on_lattice.h"
#include "procedural/pattern/pattern_pieces.h"
#include "procedural/texture/carried_tangent.h"
#include "procedural/texture/site_windows.h"

namespace body_sites_test {

using namespace lamella;

namespace {

constexpr std::size_t most = 1'000'000;

std::size_t pieces(const SurfaceSites& sites) {
    return pieces_of(sites, std::vector<float>(sites.size(), 1)).sizes.size();
}

}  // namespace

TEST_CASE("sites cover a surface evenly, each linked to those around it", "[texture]") {
    struct Case {
        FieldPtr body;
        double area;
    };
    const double pi = std::numbers::pi;
    for (const Case& tried :
         {Case{make_sphere({1, 2, 3}, 6), 4 * pi * 36}, Case{make_torus({0, 0, 0}, 8, 3), 4 * pi * pi * 24},
          Case{make_box({{-4, -4, -3}, {4, 4, 3}}), 2 * 64 + 4 * 48}}) {
        const SurfaceSites sites = sites_on_surface(*tried.body, 0.25, most, nullptr);
        const double a_square = static_cast<double>(sites.size()) * 0.0625 / tried.area;
        CHECK(a_square > 0.95);
        CHECK(a_square < 1.75);
        CHECK(pieces(sites) == 1);
        for (std::size_t i = 0; i < sites.size(); ++i) {
            REQUIRE(std::abs(tried.body->value(sites.places[i])) < 1e-3);
            REQUIRE(sites.neighbours(i).size() >= 3);  // at corners
        }
    }
}

TEST_CASE("the two sides of a thin wall are not neighbours", "[texture]") {
    const auto shell = make_box({{-5, -5, -0.15}, {5, 5, 0.15}});
    const SurfaceSites sites = sites_on_surface(*shell, 0.2, most, nullptr);
    for (std::size_t i = 0; i < sites.size(); ++i) {
        if (std::abs(sites.normals[i].z) < 0.99 ||
            std::max(std::abs(sites.places[i].x), std::abs(sites.places[i].y)) > 4.5)
            continue;
        for (const std::uint32_t other : sites.neighbours(i))
            CHECK(sites.places[other].z == Approx(sites.places[i].z).margin(1e-3));
    }
}

TEST_CASE("tangents lie in the surface, and follow an axis or each other", "[texture]") {
    SurfaceSites sites = sites_on_surface(*make_cylinder({0, 0, -10}, {0, 0, 10}, 6), 0.4, most, nullptr);
    set_tangents(sites, nullptr, dvec3(0, 0, 1), 0);
    const auto is_aside = [&](std::size_t i) { return std::abs(sites.places[i].z) < 9; };
    for (std::size_t i = 0; i < sites.size(); ++i) {
        CHECK(glm::dot(sites.tangents[i], sites.normals[i]) == Approx(0).margin(1e-9));
        CHECK(glm::dot(sites.tangents[i], sites.tangents[i]) == Approx(1));
        if (is_aside(i)) CHECK(glm::cross(sites.normals[i], sites.tangents[i]).z == Approx(1));
    }
    // A closed surface has singular points; elsewhere neighbours agree.
    SurfaceSites coarse = sites_on_surface(*make_cylinder({0, 0, -10}, {0, 0, 10}, 6), 1.2, most, nullptr);
    set_tangents(coarse, nullptr, std::nullopt, 1000);
    set_tangents(sites, &coarse, std::nullopt, 5);
    int turned = 0, count = 0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        for (const std::uint32_t other : sites.neighbours(i)) {
            const dvec3 there =
                carried_tangent(sites.tangents[other], sites.normals[other], sites.normals[i]);
            turned += glm::dot(sites.tangents[i], there) < 0.9 ? 1 : 0;
            ++count;
        }
    }
    CHECK(turned < 0.005 * count);
}

TEST_CASE("windows on a cylinder are those of the sheet that it unrolls to", "[texture]") {
    constexpr double radius = 6, spacing = 0.3;
    SurfaceSites sites =
        sites_on_surface(*make_cylinder({0, 0, -10}, {0, 0, 10}, radius), spacing, most, nullptr);
    set_tangents(sites, nullptr, dvec3(0, 0, 1), 0);
    const SiteWindows windows = site_windows(sites, 9);
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < sites.size(); i += 7) {
        const dvec3 p = sites.places[i];
        if (std::abs(p.z) > 7) continue;
        for (int up = -4; up <= 4; ++up) {
            for (int across = -4; across <= 4; ++across) {
                const dvec3 q = sites.places[windows.of(i)[windows.place(across, up)]];
                const double turn = std::atan2(p.x * q.y - p.y * q.x, p.x * q.x + p.y * q.y);
                const dvec2 unrolled(radius * turn, q.z - p.z), wanted = spacing * dvec2(across, up);
                const double miss = std::sqrt(glm::dot(unrolled - wanted, unrolled - wanted)) / spacing;
                REQUIRE(miss < 1.2);
                sum += miss;
                ++count;
            }
        }
    }
    // Sites are about a square apart: the nearest one is half a spacing away at most, mostly.
    CHECK(sum / count < 0.45);
}

TEST_CASE("the points about a surface know their nearest sites", "[texture]") {
    const SurfaceSites sites = sites_on_surface(*make_torus({0, 0, 0}, 5, 2), 0.4, most, nullptr);
    const NearestOnLattice nearest(sites, 1.2, 1.2);
    int other = 0, count = 0;
    for (int z = -9; z <= 9; ++z) {
        for (int y = -20; y <= 20; y += 3) {
            for (int x = -20; x <= 20; ++x) {
                const dvec3 p = dvec3(x, y, z) * 0.4;
                double least = infinity;
                for (const dvec3 place : sites.places)
                    least = std::min(least, glm::dot(place - p, place - p));
                const std::uint32_t site = nearest.site({x, y, z});
                if (least > 1.2 * 1.2 + 1e-9) {
                    CHECK(site == NearestOnLattice::none);
                    continue;
                }
                if (std::sqrt(least) > 1.2 - 0.4 && site == NearestOnLattice::none) continue;
                REQUIRE(site != NearestOnLattice::none);
                const dvec3 way = sites.places[site] - p;
                CHECK(std::sqrt(glm::dot(way, way)) < std::sqrt(least) + 0.1);
                other += glm::dot(way, way) > least + 1e-9 ? 1 : 0;
                ++count;
            }
        }
    }
    CHECK(other < 0.02 * count);
}

TEST_CASE("points above the surface have sites as far as asked", "[texture]") {
    const SurfaceSites sites = sites_on_surface(*make_sphere({0, 0, 0}, 6), 0.4, most, nullptr);
    const NearestOnLattice nearest(sites, 2, 0.8);
    for (int x = 0; x <= 20; ++x) {
        const double height = 0.4 * x - 6;
        const bool has_site = nearest.site({x, 0, 0}) != NearestOnLattice::none;
        CAPTURE(height);
        if (height > 0.85 || height < -2) CHECK(!has_site);
        if (height < 0.4 && height > -1.6) CHECK(has_site);
    }
}

TEST_CASE("bodies with too many sites, or none, are refused", "[texture]") {
    CHECK_THROWS_AS(sites_on_surface(*make_sphere({0, 0, 0}, 6), 0.1, 1000, nullptr), InputError);
    CancelToken cancel;
    cancel.cancel();
    CHECK_THROWS_AS(sites_on_surface(*make_sphere({0, 0, 0}, 6), 0.1, most, &cancel), Interrupted);
}

}  // namespace body_sites_test
