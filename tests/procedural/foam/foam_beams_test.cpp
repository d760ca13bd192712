// Beams of lattices with known edges, and of random seeds against brute force.
#include "procedural/foam/foam_beams.h"

#include <catch2/catch.hpp>
#include <set>

#include "tests/procedural/voronoi/brute_voronoi.h"
#include "tests/procedural/voronoi/cell_among.h"

namespace foam_beams_test {

using namespace lamella;
using lamella::test::cell_among;

namespace {

/// The beams of all cells of a list, longer than nothing.
std::vector<Beam> beams_of_list(const std::vector<Seed>& seeds, double half_side) {
    std::vector<Beam> beams, lengthy;
    VoronoiCell cell;
    BeamMaker maker(NodeRadius(0.1));
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        if (cell_among(seeds, i, half_side, cell)) maker.append(cell, seeds[i], seeds, beams);
    }
    for (const Beam& beam : beams) {
        for (int axis = 0; axis < 3; ++axis) {
            REQUIRE(std::isfinite(beam.a[axis]));
            REQUIRE(std::isfinite(beam.b[axis]));
        }
        if (glm::distance(beam.a, beam.b) > 1e-7) lengthy.push_back(beam);
    }
    return lengthy;
}

using Ends = std::pair<std::array<long, 3>, std::array<long, 3>>;

/// Beams as a set of places on a lattice of 1e-6 mm, direction and repetition removed.
std::set<Ends> places(const std::vector<Beam>& beams, const Box& box) {
    std::set<Ends> ends;
    const auto rounded = [](dvec3 p) {
        return std::array{std::lround(p.x * 1e6), std::lround(p.y * 1e6), std::lround(p.z * 1e6)};
    };
    for (const Beam& beam : beams) {
        if (!box.contains(beam.a) || !box.contains(beam.b)) continue;
        const auto a = rounded(beam.a), b = rounded(beam.b);
        ends.insert({std::min(a, b), std::max(a, b)});
    }
    return ends;
}

std::vector<Seed> lattice(int n, bool centred, double jitter = 0) {
    std::vector<Seed> seeds;
    const auto add = [&](dvec3 p) {
        const CounterHash hash(12, 0, static_cast<std::int64_t>(seeds.size()), 0, 0);
        seeds.push_back(
            {p + jitter * dvec3(hash.uniform(0), hash.uniform(1), hash.uniform(2)), {0, seeds.size()}});
    };
    for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                add(dvec3(x, y, z));
                if (centred) add(dvec3(x, y, z) + 0.5);
            }
    return seeds;
}

}  // namespace

TEST_CASE("four seeds have one circumcentre, four in a plane have none", "[foam_beams]") {
    const auto center = circumcenter({dvec3(1, 2, 3), dvec3(3, 2, 3), dvec3(1, 6, 3), dvec3(1, 2, 9)});
    REQUIRE(center);
    CHECK(*center == dvec3(2, 4, 6));
    CHECK_FALSE(circumcenter({dvec3(0), dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(1, 1, 0)}));
    CHECK_FALSE(circumcenter({dvec3(0), dvec3(0), dvec3(0, 1, 0), dvec3(1, 1, 1)}));
}

TEST_CASE("a cubic lattice has the edges of its dual cubes", "[foam_beams]") {
    // Exact, and shifted by about the tolerance of a tie: each node joins eight cells.
    for (const double jitter : {0.0, 1e-15, 1e-13, 1e-12}) {
        INFO("jitter " << jitter * 1e15 << "e-15");
        const auto found = places(beams_of_list(lattice(5, false, jitter), 3), {dvec3(0.4), dvec3(3.6)});
        // The nodes 0.5 ... 3.5: 4 x 4 x 4 of them, three directions.
        CHECK(found.size() == 3 * 4 * 4 * 3);
    }
}

TEST_CASE("a cubic lattice that is barely disturbed keeps its beams on the lattice's lines", "[foam_beams]") {
    // Each node splits into several along the lines; they may stand anywhere between the old ones.
    const auto on_line = [](long v) { return std::abs(v % 1000000 - 500000) < 20; };
    std::array<double, 3> length{};
    for (const auto& [a, b] : places(beams_of_list(lattice(5, false, 1e-11), 3), {dvec3(0.4), dvec3(3.6)})) {
        int lines = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            lines += on_line(a[i]) && on_line(b[i]) && std::abs(a[i] - b[i]) < 20;
            length[i] += 1e-6 * static_cast<double>(std::abs(a[i] - b[i]));
        }
        CHECK(lines >= 2);
    }
    // Nothing is missing: each direction has 16 lines of length 3, here or there made twice.
    for (const double sum : length) CHECK(sum >= 47.99);
}

TEST_CASE("a body-centred lattice has the edges of truncated octahedra", "[foam_beams]") {
    const auto found = places(beams_of_list(lattice(5, true), 3), {dvec3(1.1), dvec3(3.1)});
    for (const auto& [a, b] : found) {
        double square = 0;
        for (std::size_t i = 0; i < 3; ++i)
            square += 1e-12 * static_cast<double>((a[i] - b[i]) * (a[i] - b[i]));
        CHECK(square == Approx(0.125).epsilon(1e-5));
    }
    // 24 edges a cell (36 shared by three), two cells a cube: 24 edges per unit volume; in a box of side 2
    // about 8 times as many, less those that cross its border.
    CHECK(found.size() > 100);
    CHECK(found.size() < 8 * 24);
}

TEST_CASE("coplanar, collinear and repeated seeds make no beams that are not numbers", "[foam_beams]") {
    std::vector<Seed> plane, line, twice = lattice(4, false);
    for (int i = 0; i < 36; ++i) plane.push_back({dvec3(i % 6, i / 6, 0), {0, plane.size()}});
    for (int i = 0; i < 9; ++i) line.push_back({dvec3(i, i, i), {0, line.size()}});
    for (const Seed& seed : lattice(4, false)) twice.push_back({seed.position, {1, seed.key.low}});
    CHECK(beams_of_list(plane, 4).empty());
    CHECK(beams_of_list(line, 4).empty());
    const Box inside{dvec3(0.4), dvec3(2.6)};
    CHECK(places(beams_of_list(twice, 4), inside) == places(beams_of_list(lattice(4, false), 4), inside));
}

TEST_CASE("cospherical seeds about one node meet in it", "[foam_beams]") {
    // Twelve corners of an icosahedron in integers would tie only roughly; the 24 signed permutations of
    // (0, 1, 2) and their multiples tie exactly.
    std::vector<Seed> seeds;
    for (int x = -2; x <= 2; ++x)
        for (int y = -2; y <= 2; ++y)
            for (int z = -2; z <= 2; ++z)
                if (x * x + y * y + z * z == 5) seeds.push_back({dvec3(x, y, z), {0, seeds.size()}});
    REQUIRE(seeds.size() == 24);
    std::vector<Beam> beams;
    VoronoiCell cell;
    BeamMaker maker(NodeRadius(0.1));
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        REQUIRE(cell_among(seeds, i, 10, cell));
        maker.append(cell, seeds[i], seeds, beams);
    }
    for (const Beam& beam : beams) {
        CHECK(glm::distance(beam.a, dvec3(0)) < 1e-9);
        CHECK(glm::distance(beam.b, dvec3(0)) < 1e-9);
    }
}

TEST_CASE("beams of random seeds are the edges found by brute force", "[foam_beams]") {
    const Box core{dvec3(0), dvec3(4)};
    for (int sample = 0; sample < 5; ++sample) {
        INFO("sample " << sample);
        std::vector<Seed> seeds;
        for (int i = 0; i < 60; ++i) {
            const CounterHash hash(77, 0, i, sample, 0);
            seeds.push_back(
                {4.0 * dvec3(hash.uniform(0), hash.uniform(1), hash.uniform(2)), {0, seeds.size()}});
        }
        std::vector<Beam> brute;
        for (const auto& [a, b] : brute_voronoi_edges(seeds, core)) brute.push_back({a, 0.1, b, 0.1});
        const Box inside = grown(core, -0.2);
        const auto expected = places(brute, inside);
        CHECK(expected.size() > 100);
        CHECK(places(beams_of_list(seeds, 20), inside) == expected);
    }
}

}  // namespace foam_beams_test
