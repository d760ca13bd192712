// Traversal from wall to wall of the largest empty brick around the ray's position.
#include "recipe/output/brick_map.h"

#include "recipe/output/whole_below.h"

namespace lamella {
namespace {

glm::ivec3 blocks_of(glm::ivec3 cells, int doublings) { return ((cells - 1) >> doublings) + 1; }

/// Returns where the ray leaves the block around a cell; blocks are 2^`doublings` cells wide.
double leaving(glm::ivec3 cell, int doublings, const BrickMap::Ray& ray) {
    const auto exit = [&](int k) {
        const int wall = ((cell[k] >> doublings) + ray.forward[k]) << doublings;
        return (wall - ray.start[k]) * ray.inverse[k];
    };
    return std::min(std::min(exit(0), exit(1)), exit(2));
}

}  // namespace

BrickMap::Ray::Ray(dvec3 from, dvec3 towards) : start(from), direction(towards), inverse(0), forward(0) {
    constexpr double never = 1e30;  // cells, until a ray leaves bricks along an axis that it keeps to
    for (int k = 0; k < 3; ++k) {
        inverse[k] = direction[k] != 0 ? 1 / direction[k] : never;
        forward[k] = direction[k] >= 0 ? 1 : 0;
    }
}

BrickMap::Level::Level(glm::ivec3 n) : size(n) {
    words.assign(
        static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) * static_cast<std::size_t>(n.z), 0);
}

BrickMap::BrickMap(glm::ivec3 cells)
    : cells_(cells),
      leaves_(blocks_of(cells, 2)),
      bricks_(blocks_of(cells, 4)),
      blocks_(blocks_of(cells, 6)) {}

void BrickMap::finish() {
    mark_above(leaves_, bricks_);
    mark_above(bricks_, blocks_);
}

void BrickMap::mark_above(const Level& below, Level& above) {
    for (int z = 0; z < below.size.z; ++z) {
        for (int y = 0; y < below.size.y; ++y) {
            for (int x = 0; x < below.size.x; ++x) {
                if (below.words[below.at(x, y, z)] != 0)
                    above.words[above.at(x >> 2, y >> 2, z >> 2)] |= bit(x, y, z);
            }
        }
    }
}

/// Returns how many doublings of its cells the empty part of a word around a cell spans: 2 for all, 1 for an
/// eighth, 0 for the cell's own bit; -1 when that bit is set.
int BrickMap::empty_in(std::uint64_t word, int x, int y, int z) {
    constexpr std::uint64_t eighth = 0x330033;  // two bits along each axis
    if (word == 0) return 2;
    if ((word & eighth << ((x & 2) | (y & 2) << 2 | (z & 2) << 4)) == 0) return 1;
    return (word & bit(x, y, z)) == 0 ? 0 : -1;
}

/// The doublings of the largest empty block around a cell; -1 when the cell itself belongs to the set.
int BrickMap::empty_doublings(glm::ivec3 cell) const {
    const Level* const levels[] = {&blocks_, &bricks_, &leaves_};
    int empty = -1;
    for (int doublings = 4; doublings >= 0 && empty < 0; doublings -= 2) {
        const Level& level = *levels[2 - doublings / 2];
        const int x = cell.x >> doublings, y = cell.y >> doublings, z = cell.z >> doublings;
        empty = empty_in(level.words[level.at(x >> 2, y >> 2, z >> 2)], x, y, z);
        if (empty >= 0) empty += doublings;
    }
    return empty;
}

std::optional<BrickMap::Crossing> BrickMap::next(const Ray& ray, double from, double to) const {
    constexpr double nudge = 1e-4;  // cells; carries the ray past a cell wall despite rounding
    for (double t = from; t < to;) {
        const dvec3 p = ray.at(t + nudge);
        const glm::ivec3 cell = whole_below(p);
        const bool holds =
            p.x >= 0 && p.y >= 0 && p.z >= 0 && cell.x < cells_.x && cell.y < cells_.y && cell.z < cells_.z;
        const int empty = holds ? empty_doublings(cell) : 0;
        const double exit = std::max(t + nudge, leaving(cell, std::max(empty, 0), ray));
        if (empty < 0) return Crossing{cell, {t, std::min(exit, to)}};
        t = exit;
    }
    return std::nullopt;
}

}  // namespace lamella
