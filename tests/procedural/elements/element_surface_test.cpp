// Surfaces of elements: closed, and of the volumes that closed forms give.
#include "procedural/elements/element_surface.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <numbers>

#include "engine/base/error.h"

namespace element_surface_test {

using namespace lamella;

namespace {

constexpr double pi = std::numbers::pi;

/// Returns whether each edge has one triangle on each side.
bool is_closed(const TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            if (a == b) return false;
            sides[std::minmax(a, b)] += a < b ? 1 : 1000;
        }
    }
    return !sides.empty() && std::ranges::all_of(sides, [](const auto& side) { return side.second == 1001; });
}

double volume(const TriangleMesh& mesh) {
    double six = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        six += glm::dot(mesh.vertices[a], glm::cross(mesh.vertices[b], mesh.vertices[c]));
    return six / 6;
}

std::vector<dvec2> square(double half, dvec2 at = dvec2(0)) {
    return {at + dvec2(-half, -half), at + dvec2(half, -half), at + dvec2(half, half),
            at + dvec2(-half, half)};
}

}  // namespace

TEST_CASE("sticks and rings have closed surfaces of their volume", "[elements]") {
    const TriangleMesh stick = stick_surface(10, 3, 0.002);
    CHECK(is_closed(stick));
    CHECK(volume(stick) == Approx(pi * 2.25 * 7 + 4.0 / 3 * pi * 3.375).epsilon(0.005));
    CHECK(stick.bounds().lo.x == Approx(-5));
    CHECK(stick.bounds().hi.y == Approx(1.5).margin(0.002));
    const TriangleMesh ring = ring_surface(8, 1.5, 0.002);
    CHECK(is_closed(ring));
    CHECK(volume(ring) == Approx(2 * pi * pi * 3.25 * 0.5625).epsilon(0.005));
    CHECK(ring.bounds().hi.x == Approx(4));
    // Coarse ones, too.
    CHECK(is_closed(stick_surface(10, 3, 5)));
    CHECK(is_closed(ring_surface(8, 1.5, 5)));
}

TEST_CASE("outlines have closed surfaces, whatever their holes and the order of their polygons",
          "[elements]") {
    const double area = 400 - 4 * 16 - 81 + 36;  // a square with five holes, an island in the middle one
    std::vector<std::vector<dvec2>> polygons{square(10),        square(2, {-7, -7}), square(2, {7, -7}),
                                             square(2, {7, 7}), square(2, {-7, 7}),  square(4.5),
                                             square(3)};
    for (int turns = 0; turns < 7; ++turns) {
        std::rotate(polygons.begin(), polygons.begin() + 1, polygons.end());
        if (turns % 2 == 1) std::ranges::reverse(polygons.back());
        const TriangleMesh mesh = outline_surface(polygons, 2);
        CHECK(is_closed(mesh));
        CHECK(volume(mesh) == Approx(2 * area));
    }
    // A comb, concave, with more corners than the least-area triangulation takes.
    std::vector<dvec2> comb{{0, 0}, {30, 0}};
    for (int tooth = 29; tooth >= 0; --tooth) {
        comb.emplace_back(tooth + 0.6, 5);
        comb.emplace_back(tooth + 0.4, 1);
    }
    double twice = 0;
    for (std::size_t i = 0; i < comb.size(); ++i) twice += cross(comb[i], comb[(i + 1) % comb.size()]);
    const TriangleMesh mesh = outline_surface({comb}, 1);
    CHECK(is_closed(mesh));
    CHECK(volume(mesh) == Approx(0.5 * twice));
    const TriangleMesh annulus = outline_surface(ring_outline(8, 1.5, 0.001), 3);
    CHECK(is_closed(annulus));
    CHECK(volume(annulus) == Approx(3 * pi * (16 - 6.25)).epsilon(0.002));
    CHECK(volume(outline_surface({stick_outline(10, 3, 0.001)}, 3)) ==
          Approx(3 * (7 * 3 + pi * 2.25)).epsilon(0.002));
}

TEST_CASE("outlines whose sides meet have no surface", "[elements]") {
    CHECK_THROWS_AS(outline_surface({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}, 1), InputError);
    CHECK_THROWS_AS(outline_surface({square(2), square(1, {1, 1})}, 1), InputError);  // at a corner
    CHECK_THROWS_AS(outline_surface({square(2), square(1, {0.5, 2})}, 1), InputError);
}

}  // namespace element_surface_test
