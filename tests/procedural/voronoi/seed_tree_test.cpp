// The seed tree: counts follow the density, places are jittered, and nothing depends on who asks.
#include "procedural/voronoi/seed_tree.h"

#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <tuple>

#include "engine/base/error.h"
#include "tests/procedural/voronoi/graded_densities.h"

namespace seed_tree_test {

using namespace lamella;

namespace {

SeedTree uniform(double cell, std::uint64_t seed = 3) {
    return {std::make_shared<const ConstantDensity>(1 / (cell * cell * cell)), 4 * cell, seed};
}

}  // namespace

TEST_CASE("with one seed per cell, every cube of that side holds exactly one seed", "[seed_tree]") {
    for (const double cell : {1.0, 4.4, 0.37, 2.0 / 3.0}) {
        CAPTURE(cell);
        const SeedTree tree = uniform(cell);
        std::map<std::tuple<int, int, int>, int> occupied;
        const Box box{dvec3(-8 * cell), dvec3(8 * cell)};
        const auto seeds = tree.seeds_in(box);
        for (const Seed& seed : seeds) {
            const glm::ivec3 at(glm::floor(seed.position / cell));
            ++occupied[{at.x, at.y, at.z}];
        }
        CHECK(seeds.size() == 16 * 16 * 16);
        CHECK(occupied.size() == 16 * 16 * 16);
        CHECK(tree.block({-2, 1, 0})->leaf_level == 1);
        CHECK(tree.block({-2, 1, 0})->hole == Approx(std::sqrt(3.0) * cell));
    }
}

TEST_CASE("seeds do not depend on the box that asks, and come in the order of keys", "[seed_tree]") {
    const SeedTree tree = uniform(1.3), other = uniform(1.3);
    const Box part{{-3, 1, -2}, {2, 4, 5}};
    std::vector<Seed> filtered;
    for (const Seed& seed : other.seeds_in({dvec3(-9), dvec3(11)})) {
        if (part.contains(seed.position)) filtered.push_back(seed);
    }
    const auto direct = tree.seeds_in(part);
    CHECK(direct == filtered);
    for (std::size_t i = 1; i < direct.size(); ++i) CHECK(direct[i - 1].key < direct[i].key);
    CHECK(tree.seeds_in(Box{}).empty());
}

TEST_CASE("another recipe seed gives other seeds", "[seed_tree]") {
    const Box box{dvec3(0), dvec3(4)};
    const auto a = uniform(1, 1).seeds_in(box), b = uniform(1, 2).seeds_in(box);
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i].position != b[i].position);
}

TEST_CASE("jitter is uniform: the mean place within the cube is its centre", "[seed_tree]") {
    dvec3 sum(0), squares(0);
    const auto seeds = uniform(1).seeds_in({dvec3(-12), dvec3(12)});
    for (const Seed& seed : seeds) {
        const dvec3 f = seed.position - glm::floor(seed.position);
        sum += f;
        squares += f * f;
    }
    const auto n = static_cast<double>(seeds.size());
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(sum[axis] / n == Approx(0.5).margin(6 * std::sqrt(1.0 / 12 / n)));
        CHECK(squares[axis] / n == Approx(1.0 / 3).margin(6 * std::sqrt(4.0 / 45 / n)));
    }
}

namespace {

/// Checks a block against its density; returns its number of seeds.
std::size_t check_block(const SeedBlock& block, const Density& density) {
    const double expected = density.integral(block.nodes[0].box);
    CHECK(std::abs(static_cast<double>(block.positions.size()) - expected) < 1);
    std::set<std::tuple<double, double, double>> places;
    for (const SeedNode& node : block.nodes) {
        for (std::uint32_t i = node.first_seed; i < node.first_seed + node.seed_count; ++i) {
            CHECK(node.box.contains(block.positions[i]));
        }
        if (node.first_child < 0) {
            const dvec3 size = node.box.size();
            if (node.seed_count > 0) CHECK(density.range(node.box).hi * size.x * size.y * size.z <= 8.0001);
            CHECK(node.seed_count <= 16);
            continue;
        }
        std::uint32_t dealt = 0;
        double total = 0;
        for (int child = 0; child < 8; ++child) {
            total += density.integral(block.nodes[static_cast<std::size_t>(node.first_child + child)].box);
        }
        for (int child = 0; child < 8; ++child) {
            const SeedNode& inner = block.nodes[static_cast<std::size_t>(node.first_child + child)];
            CHECK(std::abs(inner.seed_count - node.seed_count * density.integral(inner.box) / total) <
                  1.000001);
            dealt += inner.seed_count;
        }
        CHECK(dealt == node.seed_count);
    }
    for (const dvec3 p : block.positions) places.insert({p.x, p.y, p.z});
    CHECK(places.size() == block.positions.size());
    return block.positions.size();
}

}  // namespace

TEST_CASE("counts follow a graded density at every node of the tree", "[seed_tree]") {
    std::vector<std::shared_ptr<const Density>> densities = {
        std::make_shared<const JumpDensity>(0.3), std::make_shared<const BowlDensity>(),
        std::make_shared<const ConstantDensity>(1.0), std::make_shared<const ConstantDensity>(2.7),
        std::make_shared<const ConstantDensity>(77.3)};
    for (const auto& density : densities) {
        const SeedTree tree(density, 1.0, 11);
        double seeds = 0, expected = 0;
        for (int z = -2; z < 2; ++z) {
            for (int y = -2; y < 2; ++y) {
                for (int x = -2; x < 2; ++x) {
                    const auto block = tree.block({x, y, z});
                    seeds += static_cast<double>(check_block(*block, *density));
                    expected += density->integral(block->nodes[0].box);
                }
            }
        }
        // Each of the 64 roundings has a standard deviation of at most 1/2.
        CHECK(std::abs(seeds - expected) < 6 * 0.5 * 8);
    }
}

TEST_CASE("no empty ball is larger than a block says", "[seed_tree]") {
    const SeedTree tree(std::make_shared<const JumpDensity>(0.3), 1.0, 5);
    const auto seeds = tree.seeds_in({dvec3(-2), dvec3(3)});
    for (int i = 0; i < 400; ++i) {
        const CounterHash hash(99, 0, i, 0, 0);
        const dvec3 p(hash.uniform(0), hash.uniform(1), hash.uniform(2));
        double nearest = infinity;
        for (const Seed& seed : seeds) nearest = std::min(nearest, glm::distance(seed.position, p));
        CHECK(nearest <= tree.block({0, 0, 0})->hole);
    }
    CHECK(tree.block({-1, 0, 0})->leaf_level == 0);
    CHECK(tree.block({1, 0, 0})->leaf_level == 2);
}

TEST_CASE("impossible densities and sides are refused", "[seed_tree]") {
    const auto one = std::make_shared<const ConstantDensity>(1.0);
    CHECK_THROWS_AS(SeedTree(one, 0.0, 1), InputError);
    CHECK_THROWS_AS(SeedTree(one, -1.0, 1), InputError);
    CHECK_THROWS_AS(SeedTree(one, infinity, 1), InputError);
    CHECK_THROWS_AS(SeedTree(std::make_shared<const ConstantDensity>(0.0), 1.0, 1).block({0, 0, 0}),
                    InputError);
    CHECK_THROWS_AS(SeedTree(std::make_shared<const ConstantDensity>(1e12), 1.0, 1).block({0, 0, 0}),
                    InputError);
    CHECK_THROWS_AS(SeedTree(one, 1.0, 1).block_index({1e9, 0, 0}), InputError);
    CHECK_THROWS_AS(SeedTree(one, 1.0, 1).block_index({std::nan(""), 0, 0}), InputError);
}

}  // namespace seed_tree_test
