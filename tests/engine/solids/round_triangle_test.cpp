// Round triangles: distance, cut and wedges against the balls they are made of and their support planes.
#include "engine/solids/round_triangle.h"

#include <catch2/catch.hpp>
#include <random>

namespace round_triangle_test {

using namespace lamella;

namespace {

dvec3 random_point(std::mt19937& random, double reach) {
    std::uniform_real_distribution<double> at(-reach, reach);
    return {at(random), at(random), at(random)};
}

/// All sorts of round triangles: any radii, one radius, a radius of 0, a ball within another, corners on a
/// line, corners that coincide.
RoundTriangle random_triangle(std::mt19937& random, int sort) {
    std::uniform_real_distribution<double> radius(0.05, 0.9);
    RoundTriangle t{{random_point(random, 2), random_point(random, 2), random_point(random, 2)},
                    {radius(random), radius(random), radius(random)}};
    switch (sort % 8) {
        case 1:
            t.radii = {0.4, 0.4, 0.4};
            break;
        case 2:
            t.radii = {0, radius(random), 0};
            break;
        case 3:
            t.corners[1] = t.corners[0] + random_point(random, 0.1), t.radii[0] = 0.8, t.radii[1] = 0.1;
            break;
        case 4:
            t.corners[2] = t.corners[0] * 0.3 + t.corners[1] * 0.7;
            break;
        case 5:
            t.corners[2] = t.corners[1];
            break;
        case 6:
            t.corners[1] = t.corners[2] = t.corners[0];
            break;
        default:
            break;
    }
    return t;
}

/// The least of |p - x| - r(x) over the triangle, which is convex: a search by thirds within one by thirds.
double searched_distance(const RoundTriangle& t, dvec3 p) {
    const auto least = [](double lo, double hi, const auto& f) {
        for (int k = 0; k < 70; ++k) {
            const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
            (f(a) < f(b) ? hi : lo) = f(a) < f(b) ? b : a;
        }
        return f((lo + hi) / 2);
    };
    return least(0, 1, [&](double a) {
        return least(0, 1 - a, [&](double b) {
            const dvec3 x = t.corners[0] * (1 - a - b) + t.corners[1] * a + t.corners[2] * b;
            return glm::length(p - x) - (t.radii[0] * (1 - a - b) + t.radii[1] * a + t.radii[2] * b);
        });
    });
}

/// How far p lies beyond the support plane with this unit normal.
double beyond_plane(const RoundTriangle& t, dvec3 normal, dvec3 p) {
    double reach = -infinity;
    for (std::size_t i = 0; i < 3; ++i) reach = std::max(reach, glm::dot(normal, t.corners[i]) + t.radii[i]);
    return glm::dot(normal, p) - reach;
}

/// The most that p lies beyond any support plane with a normal near `start`, by a narrowing random search.
double supported_distance(const RoundTriangle& t, dvec3 p, dvec3 start, std::mt19937& random) {
    dvec3 best = start;
    double most = beyond_plane(t, best, p);
    for (int k = 0; k < 3000; ++k) {
        const dvec3 normal = glm::normalize(best + random_point(random, std::pow(10, -k / 500.0)));
        const double beyond = beyond_plane(t, normal, p);
        if (beyond > most) most = beyond, best = normal;
    }
    return most;
}

/// The signed distance to a convex solid is the most that p lies beyond any support plane.
double supported_distance(const RoundTriangle& t, dvec3 p, std::mt19937& random) {
    double most = -infinity;
    for (const dvec3 axis : {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)}) {
        most = std::max(
            most, std::max(supported_distance(t, p, axis, random), supported_distance(t, p, -axis, random)));
    }
    return most;
}

bool inside(const Wedge& w, dvec3 p, double slack) {
    for (std::size_t k = 0; k < 5; ++k) {
        if (glm::dot(w.normals[k], p - w.origin) > w.limits[k] + slack) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("the distance to a round triangle is the least distance to the balls about its points") {
    std::mt19937 random(41);
    for (int round = 0; round < 400; ++round) {
        const RoundTriangle t = random_triangle(random, round);
        for (int k = 0; k < 4; ++k) {
            const dvec3 p = random_point(random, 3);
            INFO("round " << round);
            REQUIRE(signed_distance(t, p) == Approx(searched_distance(t, p)).margin(1e-7));
        }
    }
}

TEST_CASE("the distance to a round triangle is exact inside too") {
    std::mt19937 random(42);
    int within = 0;
    for (int round = 0; round < 240; ++round) {
        const RoundTriangle t = random_triangle(random, round);
        std::uniform_real_distribution<double> share(0, 1);
        double a = share(random), b = share(random);
        if (a + b > 1) a = 1 - a, b = 1 - b;
        const dvec3 p =
            t.corners[0] * (1 - a - b) + t.corners[1] * a + t.corners[2] * b + random_point(random, 0.3);
        const double d = signed_distance(t, p), supported = supported_distance(t, p, random);
        within += d < 0;
        INFO("round " << round);
        REQUIRE(supported <= d + 1e-9);
        REQUIRE(supported == Approx(d).margin(5e-3));
    }
    REQUIRE(within > 80);
}

TEST_CASE("a line cuts a round triangle exactly where the distance is negative") {
    std::mt19937 random(43);
    int hits = 0;
    for (int round = 0; round < 3000; ++round) {
        const RoundTriangle t = random_triangle(random, round);
        dvec3 direction = random_point(random, 1);
        if (round % 5 == 0) direction = t.corners[1] - t.corners[0] + dvec3(1e-12);
        if (round % 7 == 0) direction = glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
        if (!(glm::length(direction) > 0)) continue;
        direction = glm::normalize(direction);
        const dvec3 p = (t.corners[0] + t.corners[1] + t.corners[2]) / 3.0 + random_point(random, 0.6);
        const auto solid = cut(t, p, direction);
        hits += solid.has_value();
        std::uniform_real_distribution<double> at(-5, 5);
        for (int k = 0; k < 40; ++k) {
            const double s = at(random), d = signed_distance(t, p + direction * s);
            if (std::abs(d) < 1e-6) continue;
            INFO("round " << round << ", t " << s << ", distance " << d);
            REQUIRE((d < 0) == (solid && solid->lo < s && s < solid->hi));
        }
    }
    REQUIRE(hits > 1500);
}

TEST_CASE("a round triangle is its wedge and its edges' beams, and nothing else") {
    std::mt19937 random(44);
    int wedges = 0, in_wedge_alone = 0;
    for (int round = 0; round < 2000; ++round) {
        const RoundTriangle t = random_triangle(random, round);
        const auto w = wedge(t);
        wedges += w.has_value();
        for (int k = 0; k < 40; ++k) {
            const dvec3 p = (t.corners[0] + t.corners[1] + t.corners[2]) / 3.0 + random_point(random, 0.8);
            const double d = signed_distance(t, p);
            if (std::abs(d) < 1e-6) continue;
            double beams = infinity;
            for (std::size_t i = 0; i < 3; ++i) beams = std::min(beams, signed_distance(edge_beam(t, i), p));
            const bool in_wedge = w && inside(*w, p, 1e-9);
            in_wedge_alone += in_wedge && beams > 0;
            INFO("round " << round << ", distance " << d);
            REQUIRE((d < 0) == (in_wedge || beams < 0));
        }
    }
    REQUIRE(wedges > 800);
    REQUIRE(in_wedge_alone > 1000);
}

TEST_CASE("a wedge is the hull of its corners") {
    std::mt19937 random(45);
    std::uniform_real_distribution<double> share(0, 1);
    for (int round = 0; round < 600; ++round) {
        const RoundTriangle t = random_triangle(random, round % 3);
        for (const auto& w : {wedge(t), inner_wedge(t, 0), inner_wedge(t, 0.3)}) {
            if (!w) continue;
            std::array<double, 5> room{};
            room.fill(-infinity);
            for (const dvec3& corner : w->corners) {
                REQUIRE(inside(*w, corner, 1e-9));
                for (std::size_t k = 0; k < 5; ++k) {
                    room[k] = std::max(room[k], glm::dot(w->normals[k], corner - w->origin) - w->limits[k]);
                }
            }
            for (std::size_t k = 0; k < 5; ++k) {
                REQUIRE(glm::length(w->normals[k]) == Approx(1));
                REQUIRE(room[k] == Approx(0).margin(1e-9));
            }
        }
    }
}

TEST_CASE("the inner wedge holds the points behind the face whose nearest ball stands on it") {
    std::mt19937 random(46);
    std::uniform_real_distribution<double> share(0, 1);
    int checked = 0;
    for (int round = 0; round < 3000; ++round) {
        const RoundTriangle t = random_triangle(random, round % 3);
        const auto w = inner_wedge(t, 0);
        if (!w) continue;
        const dvec3 p = (t.corners[0] + t.corners[1] + t.corners[2]) / 3.0 + random_point(random, 0.8);
        const dvec3 normal =
            glm::normalize(glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]));
        const double d = signed_distance(t, p), height = glm::dot(normal, p - t.corners[0]);
        double edges = infinity;
        for (std::size_t i = 0; i < 3; ++i) edges = std::min(edges, signed_distance(edge_beam(t, i), p));
        if (std::abs(d) < 1e-6 || std::abs(height) < 1e-6 || std::abs(d - edges) < 1e-6) continue;
        ++checked;
        INFO("round " << round);
        REQUIRE(inside(*w, p, 1e-9) == (d < 0 && height < 0 && d < edges));
    }
    REQUIRE(checked > 1000);
}

TEST_CASE("the box of a round triangle is that of its three balls") {
    const RoundTriangle t{{dvec3(0, 0, 0), dvec3(3, 1, 0), dvec3(1, 2, 5)}, {1, 0.5, 0}};
    const Box box = bounds(t);
    CHECK(box.lo == dvec3(-1, -1, -1));
    CHECK(box.hi == dvec3(3.5, 2, 5));
}

}  // namespace round_triangle_test
