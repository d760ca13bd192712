// The octree of cells: sizes asked for, balance, and a partition of space.
#include "procedural/lattice/cell_octree.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/base/error.h"
#include "tests/engine/field/gradings.h"

namespace cell_octree_test {

using namespace lamella;

namespace {

constexpr std::size_t cache = std::size_t{16} << 20;

std::vector<OctreeCell> cells_in(const CellOctree& octree, const Box& box) {
    std::vector<OctreeCell> cells;
    octree.for_each(box, [&](const OctreeCell& cell) { cells.push_back(cell); });
    return cells;
}

/// The leaf cube that contains the point; a cube includes its lower faces.
OctreeCell cell_at(const CellOctree& octree, dvec3 p) {
    std::vector<OctreeCell> found = cells_in(octree, {p, p});
    std::erase_if(found, [&](const OctreeCell& cell) {
        const Box box = octree.box(cell);
        return glm::any(glm::lessThan(p, box.lo)) || glm::any(glm::greaterThanEqual(p, box.hi));
    });
    REQUIRE(found.size() == 1);
    return found.front();
}

double volume(const Box& box) {
    const dvec3 size = box.size();
    return size.x * size.y * size.z;
}

}  // namespace

TEST_CASE("one size asked for makes one size of cells, from the region's corner", "[cell_octree]") {
    const Box region{{0.3, -0.2, 1}, {7, 5, 4}};
    const CellOctree octree(make_constant_grading(1.3), region, cache);
    CHECK(octree.levels() == 0);
    CHECK(octree.coarse_side() == 1.3);
    CHECK(cell_at(octree, region.lo + 0.01) == OctreeCell{{0, 0, 0}, 0});
    CHECK(cell_at(octree, region.lo - 0.01) == OctreeCell{{-1, -1, -1}, 0});
    CHECK(cells_in(octree, grown(region, -0.01)).size() == 6 * 4 * 3);
}

TEST_CASE("cells partition space, are as small as asked, and differ by one halving at most",
          "[cell_octree]") {
    const Box region{dvec3(0), {24, 16, 16}};
    const auto step = std::make_shared<Step>(12.7, 0.5, 8);
    const auto slope = std::make_shared<Linear>(8, dvec3(-0.3, 0, 0));
    for (const GradingPtr& size : {GradingPtr(step), GradingPtr(slope)}) {
        const CellOctree octree(size, region, cache);
        CHECK(octree.coarse_side() == 8);
        const auto cells = cells_in(octree, grown(region, -1e-3));
        double sum = 0;
        for (const OctreeCell& cell : cells) {
            const Box box = octree.box(cell);
            sum += volume(box);
            REQUIRE(cell_at(octree, box.center()) == cell);
            REQUIRE(cell_at(octree, box.lo) == cell);
            // The least size asked for within, to what the cell keeps.
            const double least = std::max(0.5, size->range(intersect(box, region)).lo);
            const double side = octree.side(cell.level);
            REQUIRE(side * std::sqrt(0.5) <= least);
            if (cell.level == 0) continue;
            // Its parent was divided for a small size in it, or for a small cell that touches it.
            const OctreeCell parent{{cell.index.x >> 1, cell.index.y >> 1, cell.index.z >> 1},
                                    cell.level - 1};
            const Box whole = octree.box(parent);
            bool reason = size->range(intersect(whole, region)).lo < 2 * side * std::sqrt(0.5);
            for (const OctreeCell& other : cells) {
                reason |= other.level > cell.level && !intersect(octree.box(other), whole).empty();
            }
            REQUIRE(reason);
        }
        CHECK(sum == Approx(volume(region)));
        for (const OctreeCell& a : cells) {
            for (const OctreeCell& b : cells) {
                if (a.level < b.level + 2 && b.level < a.level + 2) continue;
                REQUIRE(intersect(octree.box(a), octree.box(b)).empty());
            }
        }
    }
}

TEST_CASE("what a box sees of the octree does not depend on what else is asked", "[cell_octree]") {
    const Box region{dvec3(0), {24, 16, 16}};
    const CellOctree octree(std::make_shared<Step>(12.7, 1, 8), region, cache);
    const CellOctree fresh(std::make_shared<Step>(12.7, 1, 8), region, 1 << 16);
    const auto all = cells_in(octree, grown(region, 20));
    std::mt19937 random(6);
    std::uniform_real_distribution<double> place(-20, 40), size(0, 6);
    for (int i = 0; i < 20; ++i) {
        const dvec3 lo(place(random), place(random) * 0.6, place(random) * 0.6);
        const Box box =
            intersect({lo, lo + dvec3(size(random), size(random), size(random))}, grown(region, 20));
        std::vector<OctreeCell> expected;
        for (const OctreeCell& cell : all) {
            if (!intersect(octree.box(cell), box).empty()) expected.push_back(cell);
        }
        REQUIRE(cells_in(fresh, box) == expected);
    }
}

TEST_CASE("cell sizes out of range are refused", "[cell_octree]") {
    const Box region{dvec3(0), dvec3(10)};
    REQUIRE_THROWS_AS(CellOctree(make_constant_grading(0), region, cache), InputError);
    REQUIRE_THROWS_AS(CellOctree(make_constant_grading(infinity), region, cache), InputError);
    REQUIRE_THROWS_AS(CellOctree(std::make_shared<Undefined>(), region, cache), InputError);
    REQUIRE_THROWS_WITH(CellOctree(std::make_shared<Step>(5, 0.01, 8), region, cache),
                        Catch::Contains("64 times the smallest"));
    const CellOctree octree(make_constant_grading(1e-3), region, cache);
    REQUIRE_THROWS_AS(cells_in(octree, region), InputError);
}

}  // namespace cell_octree_test
