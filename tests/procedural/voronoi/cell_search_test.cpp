// The searches agree with each other and with a list of all seeds, and every vertex has an empty ball.
#include "procedural/voronoi/cell_search.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>

#include "procedural/foam/foam_beams.h"
#include "tests/procedural/voronoi/cell_among.h"
#include "tests/procedural/voronoi/graded_densities.h"

namespace cell_search_test {

using namespace lamella;
using lamella::test::cell_among;

namespace {

using Nodes = std::vector<std::array<SeedKey, 3>>;

/// A cell in a form that does not depend on the order of clipping: the keys of each vertex, sorted.
Nodes canonical(const VoronoiCell& cell, std::span<const Seed> sites) {
    Nodes nodes;
    for (std::size_t v = 0; v < cell.vertex_count(); ++v) {
        std::array<SeedKey, 3> keys;
        const auto planes = cell.planes(v);
        for (std::size_t i = 0; i < 3; ++i) {
            REQUIRE(planes[i] >= 0);
            keys[i] = sites[static_cast<std::size_t>(planes[i])].key;
        }
        std::sort(keys.begin(), keys.end());
        nodes.push_back(keys);
    }
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

std::vector<Beam> beams_of(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites) {
    std::vector<Beam> beams;
    BeamMaker(NodeRadius(0.1)).append(cell, own, sites, beams);
    return beams;
}

/// Compares the tree search with a list of all seeds about; checks the empty balls by brute force.
void check_graded(const SeedTree& tree, const Box& box, double reach, std::size_t stride) {
    const auto near = tree.seeds_in(grown(box, 2 * reach));
    TreeSearch search(tree);
    VoronoiCell cell, reference;
    std::size_t index = 0;
    for (std::size_t i = 0; i < near.size(); ++i) {
        if (!box.contains(near[i].position) || ++index % stride != 0) continue;
        search.cell(near[i], cell);
        REQUIRE(cell.reach_squared() <= reach * reach);
        REQUIRE(cell_among(near, i, 2 * tree.coarse_side(), reference));
        CHECK(canonical(cell, search.sites()) == canonical(reference, near));
        CHECK(beams_of(cell, near[i], search.sites()) == beams_of(reference, near[i], near));
        for (std::size_t v = 0; v < cell.vertex_count(); ++v) {
            const dvec3 p = near[i].position + cell.vertex(v);
            const double radius = glm::distance(p, near[i].position);
            double nearest = infinity;
            for (const Seed& seed : near) nearest = std::min(nearest, glm::distance(seed.position, p));
            REQUIRE(nearest == Approx(radius).epsilon(1e-9));
        }
    }
    CHECK(index >= stride);
}

}  // namespace

TEST_CASE("rings give the tree's cells, bit for bit", "[cell_search]") {
    const SeedTree tree(std::make_shared<const ConstantDensity>(1.0), 4.0, 21);
    RingSearch rings(tree);
    TreeSearch search(tree);
    VoronoiCell cell, reference;
    std::size_t compared = 0, beyond = 0;
    for (int x = -1; x < 3; ++x) {
        const Box box = tree.block_box({x, 5, -3});
        REQUIRE(rings.gather(box));
        for (std::size_t i = 0; i < rings.sites().size(); ++i) {
            const Seed own = rings.sites()[i];
            if (!box.contains(own.position)) continue;
            if (!rings.cell(i, cell)) {
                ++beyond;
                continue;
            }
            search.cell(own, reference);
            CHECK(canonical(cell, rings.sites()) == canonical(reference, search.sites()));
            CHECK(beams_of(cell, own, rings.sites()) == beams_of(reference, own, search.sites()));
            ++compared;
        }
    }
    CHECK(compared > 250);
    CHECK(beyond <= 5);
}

TEST_CASE("rings also serve lattices with empty places", "[cell_search]") {
    // Five seeds in a leaf of eight places.
    const SeedTree tree(std::make_shared<const ConstantDensity>(5.0), 1.0, 2);
    RingSearch rings(tree);
    TreeSearch search(tree);
    VoronoiCell cell, reference;
    std::size_t compared = 0;
    for (int x = 0; x < 30; ++x) {
        const Box box = tree.block_box({x, 0, 0});
        REQUIRE(rings.gather(box));
        for (std::size_t i = 0; i < rings.sites().size(); ++i) {
            const Seed own = rings.sites()[i];
            if (!box.contains(own.position) || !rings.cell(i, cell)) continue;
            search.cell(own, reference);
            CHECK(canonical(cell, rings.sites()) == canonical(reference, search.sites()));
            ++compared;
        }
    }
    CHECK(compared > 100);
}

TEST_CASE("rings decline where leaves have several levels", "[cell_search]") {
    const SeedTree tree(std::make_shared<const JumpDensity>(0.3), 1.0, 5);
    CHECK_FALSE(RingSearch(tree).gather(tree.block_box({0, 0, 0})));
}

TEST_CASE("cells at a density jump of 512 are exact", "[cell_search]") {
    const SeedTree tree(std::make_shared<const JumpDensity>(0.3), 1.0, 5);
    check_graded(tree, {{0.1, 0.3, 0.3}, {0.6, 0.6, 0.6}}, 1.75, 3);
    check_graded(tree, {{-1.5, 0, 0}, {0.25, 1, 1}}, 1.75, 1);
}

TEST_CASE("cells in a smoothly graded density are exact", "[cell_search]") {
    const SeedTree tree(std::make_shared<const BowlDensity>(), 1.0, 6);
    check_graded(tree, {{-1, -1, 0}, {2, 2, 1}}, 1.75, 2);
}

TEST_CASE("of two seeds in one place, the lower key has the cell", "[cell_search]") {
    std::vector<Seed> seeds;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) seeds.push_back({dvec3(x, y, z), {0, seeds.size()}});
    seeds.push_back({dvec3(0), {0, 99}});
    VoronoiCell cell;
    CHECK(cell_among(seeds, 13, 5, cell));
    CHECK(cell.vertex_count() == 8);
    CHECK_FALSE(cell_among(seeds, 27, 5, cell));
}

}  // namespace cell_search_test
