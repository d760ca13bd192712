// Attributes at closest points against a search through all triangles.
#include "procedural/grading/attribute_grading.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "engine/base/error.h"
#include "engine/mesh/triangle_tree.h"
#include "engine/solids/triangle_distance.h"
#include "tests/engine/mesh/mesh_samples.h"
#include "tests/procedural/grading/grading_checks.h"
#include "tests/procedural/volume/scratch_folder.h"

namespace attribute_grading_test {

using namespace lamella;

namespace {

/// A bumpy sphere around the origin, radius about 10, with a value at each vertex.
AttributedMesh bumpy_sphere(int rings, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> bump(8, 12), number(-1, 3);
    AttributedMesh surface;
    const int around = 2 * rings;
    for (int i = 0; i <= rings; ++i) {
        for (int j = 0; j < around; ++j) {
            const double u = 3.14159265358979 * i / rings, v = 3.14159265358979 * j / rings;
            surface.mesh.vertices.push_back(
                dvec3(std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u)) * bump(random));
            surface.values.push_back(number(random));
        }
    }
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < around; ++j) {
            const auto vertex = [&](int a, int b) {
                return static_cast<std::uint32_t>(a * around + b % around);
            };
            surface.mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
            surface.mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
        }
    }
    return surface;
}

/// The least number of a convex function on 0..1, by thirds.
template <class Function>
double least(const Function& function) {
    double lo = 0, hi = 1;
    for (int i = 0; i < 80; ++i) {
        const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
        (function(a) < function(b) ? hi : lo) = function(a) < function(b) ? b : a;
    }
    return function((lo + hi) / 2);
}

/// The distance to a triangle: the least over v of the least over w of a + v (b - a) + w (1 - v) (c - a).
double searched_distance(dvec3 p, dvec3 a, dvec3 b, dvec3 c) {
    return least([&](double v) {
        return least([&](double w) { return glm::length(p - a - (b - a) * v - (c - a) * (w * (1 - v))); });
    });
}

const Box space{{-20, -20, -20}, {20, 20, 20}};

std::string message_of(const std::string& path, const std::string& attribute) {
    try {
        make_attribute_grading(path, attribute, 1, 1);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("the closest point of a triangle is that of a search over it") {
    std::mt19937 random(1);
    for (int i = 0; i < 300; ++i) {
        const dvec3 a = checks::random_point(random, space), b = checks::random_point(random, space),
                    c = checks::random_point(random, space),
                    p = checks::random_point(random, grown(space, 20));
        const SurfacePoint found = closest_point(p, a, b, c);
        const dvec3 w = found.weights;
        CHECK(found.distance == Approx(searched_distance(p, a, b, c)).epsilon(1e-7));
        CHECK(found.distance == Approx(glm::length(p - (a * w.x + b * w.y + c * w.z))).epsilon(1e-9));
        CHECK(std::min({w.x, w.y, w.z}) >= 0);
        CHECK(w.x + w.y + w.z == Approx(1));
    }
}

TEST_CASE("the closest point of a triangle without area is that of its edges") {
    const SurfacePoint line = closest_point({3, 4, 0}, {0, 0, 0}, {10, 0, 0}, {5, 0, 0});
    CHECK(line.distance == 4);
    const SurfacePoint spot = closest_point({3, 4, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0});
    CHECK(spot.distance == 5);
    CHECK(spot.weights.x + spot.weights.y + spot.weights.z == 1);
    // A line but for its rounding, which has a normal: the point lies beyond its end at (0, 0, 4).
    const dvec3 a(0, 0, 2), b(-5.87747175e-39, 2.93873588e-39, 0), c(0, 0, 4), p(2, 4, 9);
    const SurfacePoint end = closest_point(p, a, b, c);
    CHECK(end.distance == Approx(std::sqrt(45.0)));
    CHECK(end.weights == dvec3(0, 0, 1));
    CHECK(squared_distance(p, a, b, c) == Approx(45));
}

TEST_CASE("the number at a point is that of the closest of all triangles, the first of equal ones") {
    const AttributedMesh surface = bumpy_sphere(12, 2);
    const GradingPtr grading = make_attribute_grading(surface, 3);
    const TriangleTree tree(surface.mesh);
    std::mt19937 random(3);
    for (int i = 0; i < 1000; ++i) {
        const dvec3 p = i % 2 == 0 ? checks::random_point(random, space)
                                   : dvec3(checks::random_point(random, space)) * 0.3;
        SurfacePoint best;
        for (std::uint32_t t = 0; t < surface.mesh.triangles.size(); ++t) {
            const auto& corners = surface.mesh.triangles[t];
            SurfacePoint at =
                closest_point(p, surface.mesh.vertices[corners[0]], surface.mesh.vertices[corners[1]],
                              surface.mesh.vertices[corners[2]]);
            at.triangle = t;
            if (at.distance < best.distance) best = at;
        }
        const SurfacePoint found = tree.closest(p);
        if (found.triangle != best.triangle || found.distance != best.distance)
            FAIL("another triangle is closest");
        CHECK(found.distance == Approx(tree.distance(p)).margin(1e-9));
        const auto& corners = surface.mesh.triangles[best.triangle];
        double number = 0;
        for (int k = 0; k < 3; ++k)
            number += 3 * surface.values[corners[static_cast<std::size_t>(k)]] * best.weights[k];
        CHECK(grading->at(p) == Approx(number).margin(1e-12));
    }
}

TEST_CASE("a linear attribute of a flat square comes back linear above it, constant beyond its border") {
    AttributedMesh square;
    square.mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
    square.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    square.values = {0, 4, 8, 4};  // x + y
    const GradingPtr grading = make_attribute_grading(square);
    CHECK(grading->at({1, 2, 7}) == Approx(3));
    CHECK(grading->at({3, 0.5, -2}) == Approx(3.5));
    CHECK(grading->at({9, 1, 1}) == Approx(5));
    CHECK(grading->at({9, 9, 1}) == 8);
    const Interval range = grading->range({{1, 1, 2}, {1.5, 1.5, 2.5}});
    CHECK(range.lo == Approx(2).margin(0.4));
    CHECK(range.hi == Approx(3).margin(0.4));
}

TEST_CASE("ranges of attributes enclose their numbers and narrow with the box") {
    for (const int rings : {2, 8, 30}) {
        const GradingPtr grading = make_attribute_grading(bumpy_sphere(rings, 5), 1);
        checks::check_ranges(*grading, space, 6);
        checks::check_ranges(*grading, {dvec3(-0.5), dvec3(0.5)},
                             7);  // near the centre many are nearly closest
    }
    AttributedMesh box{samples::box_mesh({-10, -10, -10}, {10, 10, 10}), {}};
    for (int i = 0; i < 8; ++i) box.values.push_back(i);
    const GradingPtr grading = make_attribute_grading(box);
    checks::check_ranges(*grading, space, 8);
    std::mt19937 random(9);
    for (int i = 0; i < 200; ++i) {
        const dvec3 at(glm::mix(5.0, 9.0, i / 200.0), 0.3 + i * 0.01, -0.2 - i * 0.011);
        CHECK(grading->range({at - 1e-6, at + 1e-6}).width() < 1e-5);
    }
    CHECK(grading->range(grown(space, 100)).lo == 0);
    CHECK(grading->range(grown(space, 100)).hi == 7);
}

TEST_CASE("ranges of attributes on slivers enclose their numbers") {
    AttributedMesh fan;
    for (int i = 0; i <= 200; ++i) {
        fan.mesh.vertices.emplace_back(10 + i * 1e-7, i % 2 * 1e-9, i % 3 * 1e-8);
        fan.values.push_back(i % 7);
    }
    fan.mesh.vertices.emplace_back(-10, 0, 0);
    fan.values.push_back(3);
    for (std::uint32_t i = 0; i < 200; ++i) fan.mesh.triangles.push_back({201, i, i + 1});
    fan.mesh.triangles.push_back({0, 100, 200});
    const GradingPtr grading = make_attribute_grading(fan);
    checks::check_ranges(*grading, space, 10);
    checks::check_ranges(*grading, {{9.9, -0.1, -0.1}, {10.1, 0.1, 0.1}}, 11);
}

TEST_CASE("an undefined corner leaves its triangles undefined and the others as they are") {
    AttributedMesh square;
    square.mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
    square.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    square.values = {1, std::nan(""), 1, 1};
    const GradingPtr grading = make_attribute_grading(square);
    CHECK(std::isnan(grading->at({3, 1, 1})));
    CHECK(grading->at({1, 3, 1}) == 1);
    CHECK(grading->range({{2.9, 0.9, 1}, {3, 1, 1}}).hi == infinity);
    CHECK(grading->range({{0.9, 2.9, 1}, {1, 3, 1}}).hi == 1);
    checks::check_ranges(*grading, space, 12);
}

TEST_CASE("an attribute is read from a file and scaled") {
    const ScratchFolder folder("attribute");
    const std::string path = (folder / "a.ply").string();
    std::ofstream(path) << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                           "property float z\nproperty uchar red\nproperty float quality\nelement face 1\n"
                           "property list uchar int vertex_indices\nend_header\n"
                           "0 0 0 0 5\n1 0 0 255 6\n0 1 0 51 7\n3 0 1 2\n";
    CHECK(make_attribute_grading(path, "red", 10, 2)->at({11, 0, 3}) == 2);
    CHECK(make_attribute_grading(path, "red", 10, 2)->at({0, 11, 3}) == Approx(0.4));
    CHECK(make_attribute_grading(path, "quality", 10, 1)->at({5, 0, 3}) == Approx(5.5));
    CHECK(message_of(path, "blue") ==
          path + ": its vertices have no number named \"blue\"; there are \"red\", \"quality\"");
    CHECK(message_of((folder / "b.ply").string(), "red").find("b.ply: cannot be opened") !=
          std::string::npos);
    CHECK_THROWS_AS(make_attribute_grading(path, "red", 1, infinity), InputError);
    CHECK_THROWS_AS(make_attribute_grading(path, "red", 0, 1), InputError);
    CHECK_THROWS_AS(make_attribute_grading(AttributedMesh{}), InputError);
}

}  // namespace attribute_grading_test
