// Graded meshes: how well the number is met over the triangles, and what division leaves alone.
#include "engine/mesh/graded_mesh.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/mesh/mesh_edges.h"
#include "tests/engine/field/gradings.h"
#include "tests/engine/solids/shapes.h"

namespace graded_mesh_test {

using namespace lamella;

namespace {

double volume(const TriangleMesh& mesh) {
    double sum = 0;
    for (const auto& t : mesh.triangles) {
        sum += glm::dot(mesh.vertices[t[0]], glm::cross(mesh.vertices[t[1]], mesh.vertices[t[2]])) / 6;
    }
    return sum;
}

/// The largest difference between the grading and its interpolation at random points of triangles, as a share
/// of the largest number on the triangle.
double worst_share(const GradedMesh& graded, const Grading& grading) {
    std::mt19937 random(71);
    std::uniform_real_distribution<double> share(0, 1);
    double worst = 0;
    for (const auto& t : graded.mesh.triangles) {
        double largest = 0, deviation = 0;
        for (int k = 0; k < 30; ++k) {
            double a = share(random), b = share(random);
            if (a + b > 1) a = 1 - a, b = 1 - b;
            const auto mean = [&](const auto& of) {
                return of[t[0]] * (1 - a - b) + of[t[1]] * a + of[t[2]] * b;
            };
            const double number = grading.at(mean(graded.mesh.vertices));
            largest = std::max(largest, number);
            deviation = std::max(deviation, std::abs(number - mean(graded.numbers)));
        }
        if (largest > 0) worst = std::max(worst, deviation / largest);
    }
    return worst;
}

}  // namespace

TEST_CASE("a number that is linear in space divides no triangle") {
    const TriangleMesh box = shapes::box({-5, -5, -5}, {5, 5, 5});
    const GradingPtr linear = steady_function([](dvec3 p) { return 1 + 0.1 * p.x - 0.05 * p.z; }, 0.12);
    const GradedMesh graded = read_on_mesh(*linear, box);
    CHECK(graded.mesh.triangles == box.triangles);
    CHECK(graded.mesh.vertices == box.vertices);
    for (std::size_t v = 0; v < box.vertices.size(); ++v)
        CHECK(graded.numbers[v] == linear->at(box.vertices[v]));
}

TEST_CASE("a number that bends is met to two percent, and the mesh stays closed, oriented and where it was") {
    const GradingPtr bend =
        steady_function([](dvec3 p) { return 0.8 + 0.03 * p.x * p.x + 0.02 * p.y * p.z; }, 0.6);
    for (const TriangleMesh& mesh :
         {shapes::box({-5, -5, -5}, {5, 5, 5}), shapes::icosphere(1, 5), shapes::l_prism()}) {
        const GradedMesh graded = read_on_mesh(*bend, mesh);
        CHECK(worst_share(graded, *bend) < 0.025);
        CHECK(graded.numbers.size() == graded.mesh.vertices.size());
        CHECK(MeshEdges(graded.mesh.triangles, graded.mesh.vertices.size()).is_oriented_manifold());
        CHECK(volume(graded.mesh) == Approx(volume(mesh)).epsilon(1e-9));
        const GradedMesh again = read_on_mesh(*bend, mesh);
        CHECK(again.mesh.triangles == graded.mesh.triangles);
        CHECK(again.mesh.vertices == graded.mesh.vertices);
        CHECK(again.numbers == graded.numbers);
    }
}

TEST_CASE("at a step the triangles get small against the number, and no smaller") {
    const GradingPtr step = steady_function([](dvec3 p) { return p.x + 0.3 * p.y < 0.4 ? 0.0 : 1.0; }, 1e9);
    const TriangleMesh box = shapes::box({-5, -5, -5}, {5, 5, 5});
    const GradedMesh graded = read_on_mesh(*step, box);
    CHECK(graded.mesh.triangles.size() < 20000);
    CHECK(MeshEdges(graded.mesh.triangles, graded.mesh.vertices.size()).is_oriented_manifold());
    double longest = 0, shortest = infinity;
    for (const auto& t : graded.mesh.triangles) {
        const double n[3] = {graded.numbers[t[0]], graded.numbers[t[1]], graded.numbers[t[2]]};
        for (std::size_t e = 0; e < 3; ++e) {
            const double edge =
                glm::length(graded.mesh.vertices[t[(e + 1) % 3]] - graded.mesh.vertices[t[e]]);
            if (n[0] != n[1] || n[0] != n[2]) longest = std::max(longest, edge);
            shortest = std::min(shortest, edge);
        }
    }
    CHECK(longest <= 0.25);
    CHECK(shortest > 0.05);
}

TEST_CASE("a spot on a large triangle is found") {
    const GradingPtr spot = steady_function(
        [](dvec3 p) { return std::max(0.1, 1 - glm::length(p - dvec3(1.3, -0.7, 5)) / 1.5); }, 0.67);
    const GradedMesh graded = read_on_mesh(*spot, shapes::box({-5, -5, -5}, {5, 5, 5}));
    CHECK(*std::max_element(graded.numbers.begin(), graded.numbers.end()) > 0.9);
    // The tip and the foot of the cone are creases; there the triangles only get small.
    CHECK(worst_share(graded, *spot) < 0.1);
}

}  // namespace graded_mesh_test
