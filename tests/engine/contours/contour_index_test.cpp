// The contour index against every edge of the contours, one by one.
#include "engine/contours/contour_index.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/field/slice_context.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"

namespace contour_index_test {

using namespace lamella;

namespace {

double edge_distance(dvec2 a, dvec2 b, dvec2 p) {
    const double t = glm::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::length(p - a - t * (b - a));
}

/// The least distance to any edge, negative where a ray to the right crosses the contours an odd number of
/// times.
double brute_distance(const std::vector<Contour>& contours, dvec2 p) {
    double least = infinity;
    bool inside = false;
    for (const Contour& contour : contours) {
        for (std::size_t k = 0; k < contour.points.size(); ++k) {
            const dvec2 a = contour.points[k], b = contour.points[(k + 1) % contour.points.size()];
            least = std::min(least, edge_distance(a, b, p));
            if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
                inside = !inside;
        }
    }
    return inside ? -least : least;
}

std::vector<Contour> scene() {
    std::vector<FieldPtr> solids{make_torus({0, 0, 0}, 8, 2), make_box({{-9, -1, -1}, {9, 1, 1}})};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-10, 10);
    for (int k = 0; k < 12; ++k) {
        const dvec3 a(place(random), place(random), 0), b(place(random), place(random), 0);
        solids.push_back(make_round_cone({a, 0.2, b, 0.4}));
    }
    SliceContext context;
    Scratch scratch;
    const FieldPtr part = make_union(solids);
    return trace_contours(context.slice(*part, 0.05), 0.05, scratch);
}

}  // namespace

TEST_CASE("distances and sides are those of all edges looked at one by one") {
    const std::vector<Contour> contours = scene();
    REQUIRE(contours.size() > 5);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> place(-12, 12);
    for (const double cell : {0.3, 1.0, 7.0}) {
        const ContourIndex index(contours, cell);
        int near = 0, far = 0;
        for (int k = 0; k < 4000; ++k) {
            const dvec2 p(place(random), place(random));
            constexpr double limit = 0.6;
            const double expected = brute_distance(contours, p);
            const auto found = index.distance(p, limit);
            REQUIRE(found.has_value() == (std::abs(expected) <= limit));
            if (!found) {
                ++far;
                continue;
            }
            ++near;
            REQUIRE(*found == Approx(expected).margin(1e-9));
        }
        REQUIRE(near > 1000);
        REQUIRE(far > 500);
    }
}

TEST_CASE("beyond a corner, however sharp, is outside") {
    Contour star;
    for (int k = 0; k < 14; ++k) {
        const double a = 2 * pi * k / 14, r = k % 2 == 0 ? 5 : 1.2;
        star.points.emplace_back(r * std::cos(a), r * std::sin(a));
    }
    const ContourIndex index({star}, 1);
    for (int k = 0; k < 14; k += 2) {
        const double a = 2 * pi * k / 14;
        for (const double turn : {-0.8, -0.2, 0.0, 0.2, 0.8}) {
            const dvec2 tip = star.points[static_cast<std::size_t>(k)];
            const dvec2 p = tip + 0.3 * dvec2(std::cos(a + turn), std::sin(a + turn));
            REQUIRE(index.distance(p, 0.5).value() == Approx(brute_distance({star}, p)));
            REQUIRE(index.distance(p, 0.5).value() > 0);
        }
    }
}

TEST_CASE("the way through a wall is its thickness, up to the limit") {
    SliceContext context;
    Scratch scratch;
    const FieldPtr wall = make_box({{-10, -0.2, -1}, {10, 0.2, 1}});
    const auto contours = trace_contours(context.slice(*wall, 0), 0.05, scratch);
    const ContourIndex index(contours, 1);
    REQUIRE(index.way_through({0.3, -0.2}, {0, 1}, 2) == Approx(0.4).margin(0.02));
    REQUIRE(index.way_through({0.3, 0.2}, {0, -1}, 2) == Approx(0.4).margin(0.02));
    REQUIRE(index.way_through({0.3, 0.2}, {0, -1}, 0.1) == 0.1);
    REQUIRE(index.way_through({-10, 0}, {1, 0}, 3) == 3);
}

TEST_CASE("an index of nothing finds nothing") {
    const ContourIndex index(std::vector<Contour>{}, 1);
    REQUIRE_FALSE(index.distance({0, 0}, 100));
    REQUIRE(index.way_through({0, 0}, {1, 0}, 2) == 2);
}

}  // namespace contour_index_test
