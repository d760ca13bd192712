// Divides each coarse cube by its own sizes first, then balances it against the cubes around it.
#include "procedural/lattice/cell_octree.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"

namespace lamella {
namespace {

constexpr double root_half = 0.70710678118654757;
constexpr double max_coarse_cubes = 1e9;  // maximum number for one query

bool before(const glm::i64vec3& a, const glm::i64vec3& b) {
    if (a.z != b.z) return a.z < b.z;
    if (a.y != b.y) return a.y < b.y;
    return a.x < b.x;
}

void sort_unique(std::vector<glm::i64vec3>& cubes) {
    std::sort(cubes.begin(), cubes.end(), before);
    cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());
}

glm::i64vec3 child(const glm::i64vec3& cube, int octant) {
    return cube * std::int64_t{2} + glm::i64vec3(octant & 1, (octant >> 1) & 1, octant >> 2);
}

glm::i64vec3 shifted_right(const glm::i64vec3& v, int bits) {
    return {v.x >> bits, v.y >> bits, v.z >> bits};
}

/// Calls visit for all integer coordinates from lo to hi, by z, y, x.
template <typename Visit>
void for_each_index(const glm::i64vec3& lo, const glm::i64vec3& hi, const Visit& visit) {
    for (std::int64_t z = lo.z; z <= hi.z; ++z) {
        for (std::int64_t y = lo.y; y <= hi.y; ++y) {
            for (std::int64_t x = lo.x; x <= hi.x; ++x) visit(glm::i64vec3(x, y, z));
        }
    }
}

}  // namespace

CellOctree::CellOctree(GradingPtr size, const Box& region, std::size_t cache_bytes)
    : size_(std::move(size)), region_(region), wanted_(cache_bytes), balanced_(cache_bytes) {
    const Interval sizes = positive_range(*size_, region, "the lattice's cell size");
    coarse_side_ = sizes.hi;
    min_size_ = sizes.lo;
    // Sides are exact, so the comparison has the same result on every machine.
    while (side(levels_) * root_half > sizes.lo) {
        if (++levels_ > max_halvings) {
            throw InputError(
                fmt::format("the lattice's cell size goes from {:.6g} to {:.6g} mm; the largest may be "
                            "{} times the smallest",
                            sizes.lo, sizes.hi, 1 << max_halvings));
        }
    }
}

Box CellOctree::box(const OctreeCell& cell) const {
    const double edge = side(cell.level);
    return {region_.lo + dvec3(cell.index) * edge, region_.lo + dvec3(cell.index + std::int64_t{1}) * edge};
}

bool CellOctree::too_large(const OctreeCell& cell) const {
    if (cell.level >= levels_) return false;
    const Box cube = box(cell);
    const Box near{glm::clamp(cube.lo, region_.lo, region_.hi), glm::clamp(cube.hi, region_.lo, region_.hi)};
    return std::max(size_->range(near).lo, min_size_) < side(cell.level) * root_half;
}

bool CellOctree::Divisions::contains(const OctreeCell& cell) const {
    const auto level = static_cast<std::size_t>(cell.level);
    return level < by_level.size() &&
           std::binary_search(by_level[level].begin(), by_level[level].end(), cell.index, before);
}

std::size_t CellOctree::Divisions::bytes() const {
    std::size_t sum = sizeof(Divisions) + by_level.capacity() * sizeof(std::vector<glm::i64vec3>);
    for (const auto& level : by_level) sum += level.capacity() * sizeof(glm::i64vec3);
    return sum;
}

void CellOctree::divide(const OctreeCell& cell, Divisions& wanted) const {
    if (!too_large(cell)) return;
    wanted.by_level[static_cast<std::size_t>(cell.level)].push_back(cell.index);
    for (int octant = 0; octant < 8; ++octant) divide({child(cell.index, octant), cell.level + 1}, wanted);
}

CellOctree::DivisionsPtr CellOctree::wanted(glm::i64vec3 coarse) const {
    const Box cube = box({coarse, 0});
    return wanted_.find_or_make({coarse.x, coarse.y, coarse.z, 0, 0}, cube.center().z, [&] {
        Divisions divisions{std::vector<std::vector<glm::i64vec3>>(static_cast<std::size_t>(levels_)),
                            {cube.lo.z, cube.hi.z}};
        divide({coarse, 0}, divisions);
        for (auto& level : divisions.by_level) std::sort(level.begin(), level.end(), before);
        return divisions;
    });
}

CellOctree::DivisionsPtr CellOctree::balanced(glm::i64vec3 coarse) const {
    return balanced_.find_or_make({coarse.x, coarse.y, coarse.z, 0, 0}, box({coarse, 0}).center().z,
                                  [&] { return balance(coarse); });
}

/// A divided cube has children that touch all cubes of its own size around it, so the parents of those must
/// be divided, too. Divisions that follow from one spread by less than the sum of all smaller sides, which is
/// below one coarse side. So the sizes in the 27 coarse cubes around suffice.
CellOctree::Divisions CellOctree::balance(glm::i64vec3 coarse) const {
    Divisions all = *wanted(coarse);
    for_each_index(coarse - std::int64_t{1}, coarse + std::int64_t{1}, [&](const glm::i64vec3& near) {
        if (near == coarse) return;
        const auto wishes = wanted(near);
        for (std::size_t level = 0; level < all.by_level.size(); ++level) {
            const auto& more = wishes->by_level[level];
            all.by_level[level].insert(all.by_level[level].end(), more.begin(), more.end());
        }
    });
    for (std::size_t level = all.by_level.size(); level-- > 0;) {
        sort_unique(all.by_level[level]);
        if (level == 0) break;
        auto& parents = all.by_level[level - 1];
        for (const glm::i64vec3& cube : all.by_level[level]) {
            for (int side = 0; side < 8; ++side) {
                const glm::i64vec3 step(side & 1 ? 1 : -1, side & 2 ? 1 : -1, side & 4 ? 1 : -1);
                parents.push_back(shifted_right(cube + step, 1));
            }
        }
    }
    for (std::size_t level = 0; level < all.by_level.size(); ++level) {
        auto& cubes = all.by_level[level];
        std::erase_if(cubes, [&](const glm::i64vec3& cube) {
            return shifted_right(cube, static_cast<int>(level)) != coarse;
        });
        cubes.shrink_to_fit();
    }
    return all;
}

void CellOctree::for_each(const Box& where, const std::function<void(const OctreeCell&)>& visit) const {
    if (where.empty()) return;
    const auto index = [&](dvec3 p, double margin) {
        const dvec3 place = (p - region_.lo) / coarse_side_ + margin;
        return glm::i64vec3(glm::floor(glm::clamp(place, -farthest, farthest)));
    };
    // A margin for rounding. Cubes that do not meet the box are dropped later by their own boxes.
    constexpr double margin = 1e-6;
    const glm::i64vec3 first = index(where.lo, -margin), last = index(where.hi, margin);
    const dvec3 count(last - first + std::int64_t{1});
    if (count.x * count.y * count.z > max_coarse_cubes) {
        throw InputError(fmt::format("a box of {:.3g} cells is asked for; accepted: at most {:.0g}",
                                     count.x * count.y * count.z, max_coarse_cubes));
    }
    for_each_index(first, last, [&](const glm::i64vec3& coarse) {
        const OctreeCell cell{coarse, 0};
        if (intersect(box(cell), where).empty()) return;
        const DivisionsPtr divisions = levels_ > 0 ? balanced(coarse) : nullptr;
        visit_cells(cell, divisions.get(), where, visit);
    });
}

void CellOctree::visit_cells(const OctreeCell& cell, const Divisions* divisions, const Box& where,
                             const std::function<void(const OctreeCell&)>& visit) const {
    if (intersect(box(cell), where).empty()) return;
    if (!divisions || !divisions->contains(cell)) return visit(cell);
    for (int octant = 0; octant < 8; ++octant) {
        visit_cells({child(cell.index, octant), cell.level + 1}, divisions, where, visit);
    }
}

}  // namespace lamella
