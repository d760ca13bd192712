// Curves where polygons meet bodies with closed forms.
#include "procedural/foam/surface_curves.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/formula/formula_field.h"
#include "engine/formula/formula_parser.h"
#include "engine/solids/primitives.h"

namespace surface_curves_test {

using namespace lamella;

namespace {

std::vector<dvec3> hexagon(dvec3 center, double radius, dvec3 u, dvec3 v) {
    std::vector<dvec3> ring;
    for (int i = 0; i < 6; ++i) {
        ring.push_back(center + u * (radius * std::cos(pi * i / 3)) + v * (radius * std::sin(pi * i / 3)));
    }
    return ring;
}

double length(const SurfaceCurve& curve) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) sum += glm::distance(curve[i], curve[i + 1]);
    return sum;
}

FieldPtr formula(const char* text, Metric metric) {
    const std::vector<std::string> names{"x", "y", "z"};
    return make_formula_field(parse_formula(text, names), {}, {dvec3(-9), dvec3(9)}, metric);
}

}  // namespace

TEST_CASE("a polygon cut by a ball in its middle has one closed curve, a circle", "[surface_curves]") {
    const double r = 1.3, off = 0.4;
    const auto ring = hexagon({0.1, -0.2, off}, 3, {1, 0, 0}, {0, 1, 0});
    // The ball as an exact distance, and as a formula of which only the sign is known.
    for (const FieldPtr& body : {make_sphere(dvec3(0), r), formula("x^2 + y^2 + z^2 - 1.69", Metric::sign)}) {
        SurfaceTracer tracer(body);
        std::vector<SurfaceCurve> curves;
        tracer.trace(ring, curves);
        REQUIRE(curves.size() == 1);
        CHECK(curves[0].front() == curves[0].back());
        const double circle = std::sqrt(r * r - off * off);
        CHECK(length(curves[0]) == Approx(2 * pi * circle).epsilon(0.01));
        for (const dvec3& p : curves[0]) {
            CHECK(p.z == Approx(off));
            CHECK(std::abs(glm::length(p) - r) < 1e-3);
        }
    }
}

TEST_CASE("curves end at the polygon's edges, where the edges themselves are cut", "[surface_curves]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    int ended = 0;
    for (int sample = 0; sample < 60; ++sample) {
        const dvec3 center(uniform(random), uniform(random), uniform(random));
        const dvec3 u = glm::normalize(dvec3(uniform(random), uniform(random), uniform(random)));
        const dvec3 v = glm::normalize(glm::cross(u, dvec3(uniform(random), uniform(random), 1)));
        auto ring = hexagon(center, 1.5, u, v);
        SurfaceTracer tracer(make_torus({0.1, 0, 0}, 1.2, 0.5));
        std::vector<SurfaceCurve> curves;
        tracer.trace(ring, curves);
        std::vector<dvec3> ends, cuts;
        for (const SurfaceCurve& curve : curves) {
            if (curve.front() == curve.back()) continue;
            ends.push_back(curve.front());
            ends.push_back(curve.back());
        }
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const dvec3 a = ring[i], b = ring[(i + 1) % ring.size()];
            // The edge as a neighbour may give it: from the other end.
            for (const dvec3& p : sample % 2 ? tracer.inside(a, b) : tracer.inside(b, a)) {
                if (p != a && p != b) cuts.push_back(p);
            }
        }
        CHECK(ends.size() == cuts.size());
        for (const dvec3& p : cuts) CHECK(std::count(ends.begin(), ends.end(), p) == 1);
        ended += static_cast<int>(ends.size());
    }
    CHECK(ended > 60);
}

TEST_CASE("the parts of an edge inside a body are those of its closed form", "[surface_curves]") {
    SurfaceTracer tracer(make_sphere(dvec3(0), 1));
    const auto through = tracer.inside({-2, 0.6, 0}, {2, 0.6, 0});
    REQUIRE(through.size() == 2);
    CHECK(through[0].x == Approx(-0.8).margin(1e-3));
    CHECK(through[1].x == Approx(0.8).margin(1e-3));
    CHECK(tracer.inside({-2, 1.1, 0}, {2, 1.1, 0}).empty());
    const auto within = tracer.inside({-0.5, 0, 0}, {0.5, 0.1, 0});
    CHECK(within == std::vector<dvec3>{{-0.5, 0, 0}, {0.5, 0.1, 0}});
    const auto leaving = tracer.inside({0, 0, 0}, {0, 0, 3});
    REQUIRE(leaving.size() == 2);
    CHECK(leaving[0] == dvec3(0));
    CHECK(leaving[1].z == Approx(1).margin(1e-3));
}

TEST_CASE("a polygon that misses the surface has no curve", "[surface_curves]") {
    SurfaceTracer tracer(make_sphere(dvec3(0), 5));
    std::vector<SurfaceCurve> curves;
    tracer.trace(hexagon({0, 0, 1}, 2, {1, 0, 0}, {0, 1, 0}), curves);
    tracer.trace(hexagon({9, 0, 1}, 2, {1, 0, 0}, {0, 1, 0}), curves);
    CHECK(curves.empty());
}

TEST_CASE("a simplified curve keeps its ends and stays within the tolerance", "[surface_curves]") {
    SurfaceCurve wave;
    for (int i = 0; i <= 200; ++i) wave.push_back({0.05 * i, std::sin(0.05 * i), 0});
    const SurfaceCurve simple = simplified(wave, 0.02);
    CHECK(simple.front() == wave.front());
    CHECK(simple.back() == wave.back());
    CHECK(simple.size() < 40);
    for (const dvec3& p : wave) {
        double nearest = infinity;
        for (std::size_t i = 0; i + 1 < simple.size(); ++i) {
            const dvec3 along = simple[i + 1] - simple[i];
            const double t =
                std::min(std::max(glm::dot(p - simple[i], along) / glm::dot(along, along), 0.0), 1.0);
            nearest = std::min(nearest, glm::distance(p, simple[i] + along * t));
        }
        CHECK(nearest <= 0.02);
    }
}

}  // namespace surface_curves_test
