// Clipping convex cells: known polytopes, Euler's formula, and seeds that tie.
#include "procedural/voronoi/voronoi_cell.h"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "procedural/voronoi/counter_hash.h"

namespace voronoi_cell_test {

using namespace lamella;

namespace {

/// Checks Euler's formula, that three edges meet at a vertex and that all is finite and inside the reach.
void check_polytope(const VoronoiCell& cell) {
    std::map<std::int32_t, int> faces;
    std::size_t edges = 0;
    std::map<std::size_t, int> degree;
    cell.edges([&](std::int32_t a, std::int32_t b, std::size_t v, std::size_t w) {
        CHECK(a != b);
        ++faces[a];
        ++faces[b];
        ++degree[v];
        ++degree[w];
        ++edges;
    });
    const auto vertices = cell.vertex_count();
    CHECK(vertices + faces.size() == edges + 2);
    CHECK(2 * edges == 3 * vertices);
    for (const auto& [face, count] : faces) CHECK(count >= 3);
    for (std::size_t v = 0; v < vertices; ++v) {
        CHECK(degree[v] == 3);
        const dvec3 p = cell.vertex(v);
        CHECK(glm::dot(p, p) <= cell.reach_squared());
    }
}

double volume(const VoronoiCell& cell) {
    // The cell lies about the origin: sum the tetrahedra over the edges, from each face's mean point.
    std::map<std::int32_t, std::pair<dvec3, int>> means;
    const auto both = [&](auto visit) {
        cell.edges([&](std::int32_t a, std::int32_t b, std::size_t v, std::size_t w) {
            visit(a, cell.vertex(v), cell.vertex(w));
            visit(b, cell.vertex(v), cell.vertex(w));
        });
    };
    both([&](std::int32_t face, dvec3 p, dvec3 q) {
        means[face].first += p + q;
        means[face].second += 2;
    });
    double sum = 0;
    both([&](std::int32_t face, dvec3 p, dvec3 q) {
        const dvec3 mean = means[face].first / static_cast<double>(means[face].second);
        sum += std::abs(glm::dot(mean, glm::cross(p, q))) / 6;
    });
    return sum;
}

}  // namespace

TEST_CASE("a cell begins as a cube", "[voronoi_cell]") {
    VoronoiCell cell;
    cell.start(1.5);
    CHECK(cell.vertex_count() == 8);
    CHECK(cell.reach_squared() == Approx(3 * 1.5 * 1.5));
    CHECK(volume(cell) == Approx(27));
    check_polytope(cell);
}

TEST_CASE("the six nearest seeds of a cubic lattice cut out a cube, the diagonal ones nothing",
          "[voronoi_cell]") {
    VoronoiCell cell;
    cell.start(10);
    std::int32_t id = 0;
    for (const dvec3 n : {dvec3(1, 0, 0), dvec3(-1, 0, 0), dvec3(0, 1, 0), dvec3(0, -1, 0), dvec3(0, 0, 1),
                          dvec3(0, 0, -1)}) {
        CHECK(cell.clip(n, id++));
        check_polytope(cell);
    }
    CHECK(cell.vertex_count() == 8);
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) CHECK_FALSE(cell.clip({x, y, z}, id++));
    CHECK(volume(cell) == Approx(1));
}

TEST_CASE("a body-centred lattice gives the truncated octahedron", "[voronoi_cell]") {
    VoronoiCell cell;
    cell.start(10);
    std::int32_t id = 0;
    for (int s = 0; s < 8; ++s) {
        CHECK(cell.clip(0.5 * dvec3(s & 1 ? 1 : -1, s & 2 ? 1 : -1, s & 4 ? 1 : -1), id++));
        check_polytope(cell);
    }
    for (const dvec3 n : {dvec3(1, 0, 0), dvec3(-1, 0, 0), dvec3(0, 1, 0), dvec3(0, -1, 0), dvec3(0, 0, 1),
                          dvec3(0, 0, -1)}) {
        CHECK(cell.clip(n, id++));
        check_polytope(cell);
    }
    CHECK(cell.vertex_count() == 24);
    CHECK(volume(cell) == Approx(0.5));
}

TEST_CASE("a seed at the cell's own place and one that is no number cut nothing", "[voronoi_cell]") {
    VoronoiCell cell;
    cell.start(1);
    CHECK_FALSE(cell.clip({0, 0, 0}, 0));
    CHECK_FALSE(cell.clip({std::nan(""), 0, 0}, 0));
    CHECK_FALSE(cell.clip({2.0, 0, 0}, 0));
    CHECK(cell.clip({1.999, 0, 0}, 0));
}

TEST_CASE("hundreds of faces are no more trouble than six", "[voronoi_cell]") {
    VoronoiCell cell;
    cell.start(10);
    std::set<std::int32_t> faces;
    for (int i = 0; i < 600; ++i) {
        const CounterHash hash(4, 0, i, 0, 0);
        const dvec3 p = 2.0 * dvec3(hash.uniform(0), hash.uniform(1), hash.uniform(2)) - 1.0;
        const double length = std::sqrt(glm::dot(p, p));
        if (length > 1e-3) cell.clip(p / length, i);
    }
    check_polytope(cell);
    for (std::size_t v = 0; v < cell.vertex_count(); ++v) {
        for (const std::int32_t id : cell.planes(v)) faces.insert(id);
    }
    CHECK(faces.size() > 500);
    CHECK(volume(cell) == Approx(4.18879 / 8).epsilon(0.02));
}

TEST_CASE("planes that nearly tie keep the cell a polytope", "[voronoi_cell]") {
    // Seeds on a sphere's great circles, jittered by amounts about the tolerance: bundles of nearly equal
    // edges.
    for (const double jitter : {0.0, 1e-16, 1e-14, 1e-13, 1e-12, 3e-12, 1e-11, 1e-9}) {
        CAPTURE(jitter);
        for (int sample = 0; sample < 50; ++sample) {
            VoronoiCell cell;
            cell.start(2);
            for (int i = 0; i < 48; ++i) {
                const CounterHash hash(8, 0, i, sample, 0);
                const dvec3 noise = 2.0 * dvec3(hash.uniform(0), hash.uniform(1), hash.uniform(2)) - 1.0;
                const dvec3 p(hash.bits(3) % 3, hash.bits(4) % 3, hash.bits(5) % 3);
                cell.clip(p - 1.0 + jitter * noise, i);
            }
            check_polytope(cell);
        }
    }
}

}  // namespace voronoi_cell_test
