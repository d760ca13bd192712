// Traversal from wall to wall of the largest empty cube around the ray's position.
#include "recipe/output/brick_map.h"

#include <algorithm>

#include "recipe/output/whole_below.h"

namespace lamella {
namespace {

constexpr int brick_doublings = 2;  // a brick is 2^2 cells wide
constexpr std::uint8_t farthest = 255;

glm::ivec3 bricks_of(glm::ivec3 cells) { return ((cells - 1) >> brick_doublings) + 1; }

/// Returns where the ray leaves the blocks from `lower` to before `upper`; blocks are 2^`doublings` cells
/// wide.
double leaving(glm::ivec3 lower, glm::ivec3 upper, int doublings, const BrickMap::Ray& ray) {
    const auto exit = [&](int k) {
        const int wall = (ray.forward[k] != 0 ? upper[k] : lower[k]) << doublings;
        return (wall - ray.start[k]) * ray.inverse[k];
    };
    return std::min(std::min(exit(0), exit(1)), exit(2));
}

/// Lowers the distances of a row of bricks to one more than the least of their neighbours in other rows.
void near_rows(const std::vector<const std::uint8_t*>& others, std::size_t count,
               std::vector<std::uint8_t>& least, std::uint8_t* row) {
    std::fill_n(least.begin(), count + 2, farthest);
    for (const std::uint8_t* other : others) {
        for (std::size_t x = 0; x < count; ++x) least[x + 1] = std::min(least[x + 1], other[x]);
    }
    for (std::size_t x = 0; x < count; ++x) {
        const std::uint8_t near = std::min(std::min(least[x], least[x + 1]), least[x + 2]);
        row[x] = std::min(row[x], static_cast<std::uint8_t>(std::min(near, std::uint8_t{farthest - 1}) + 1));
    }
}

}  // namespace

BrickMap::Ray::Ray(dvec3 from, dvec3 towards) : start(from), direction(towards), inverse(0), forward(0) {
    constexpr double never = 1e30;  // cells, until a ray leaves bricks along an axis that it keeps to
    for (int k = 0; k < 3; ++k) {
        inverse[k] = direction[k] != 0 ? 1 / direction[k] : never;
        forward[k] = direction[k] >= 0 ? 1 : 0;
    }
}

BrickMap::BrickMap(glm::ivec3 cells) : cells_(cells), bricks_(bricks_of(cells)) {
    words_.assign(at(0, 0, bricks_.z), 0);
}

/// Chessboard distances in two sweeps, each of which looks at the neighbours that it has passed (Rosenfeld
/// and Pfaltz 1966).
void BrickMap::finish() {
    far_.resize(words_.size());
    std::ranges::transform(words_, far_.begin(),
                           [](std::uint64_t word) { return word != 0 ? std::uint8_t{0} : farthest; });
    const auto count = static_cast<std::size_t>(bricks_.x);
    std::vector<std::uint8_t> least(count + 2);
    std::vector<const std::uint8_t*> passed;
    const auto sweep = [&](int y, int z, int back) {
        passed.clear();
        const auto pass = [&](int other_y, int other_z) {
            if (other_y >= 0 && other_y < bricks_.y && other_z >= 0 && other_z < bricks_.z)
                passed.push_back(&far_[at(0, other_y, other_z)]);
        };
        for (int dy = -1; dy <= 1; ++dy) pass(y + dy, z + back);
        pass(y + back, z);
        std::uint8_t* const row = &far_[at(0, y, z)];
        near_rows(passed, count, least, row);
        const auto step = [](std::uint8_t before, std::uint8_t& here) {
            if (before < here) here = std::min(here, static_cast<std::uint8_t>(before + 1));
        };
        if (back < 0) {
            for (std::size_t x = 1; x < count; ++x) step(row[x - 1], row[x]);
        } else {
            for (std::size_t x = count - 1; x-- > 0;) step(row[x + 1], row[x]);
        }
    };
    for (int z = 0; z < bricks_.z; ++z) {
        for (int y = 0; y < bricks_.y; ++y) sweep(y, z, -1);
    }
    for (int z = bricks_.z - 1; z >= 0; --z) {
        for (int y = bricks_.y - 1; y >= 0; --y) sweep(y, z, 1);
    }
}

/// Returns how many doublings of its cells the empty part of a word around a cell spans: 1 for an eighth, 0
/// for the cell's own bit; -1 when that bit is set.
int BrickMap::empty_in(std::uint64_t word, glm::ivec3 cell) {
    constexpr std::uint64_t eighth = 0x330033;  // two bits along each axis
    if ((word & eighth << ((cell.x & 2) | (cell.y & 2) << 2 | (cell.z & 2) << 4)) == 0) return 1;
    return (word & bit(cell.x, cell.y, cell.z)) == 0 ? 0 : -1;
}

/// Returns where the ray leaves the empty cells around a cell, or the cell itself if it belongs to the set.
double BrickMap::leaving_empty(glm::ivec3 cell, const Ray& ray, bool& is_empty) const {
    const glm::ivec3 brick = cell >> brick_doublings;
    const std::size_t place = at(brick.x, brick.y, brick.z);
    is_empty = true;
    if (const int far = far_[place]; far > 0)
        return leaving(brick - (far - 1), brick + far, brick_doublings, ray);
    const int doublings = empty_in(words_[place], cell);
    is_empty = doublings >= 0;
    const glm::ivec3 block = cell >> std::max(doublings, 0);
    return leaving(block, block + 1, std::max(doublings, 0), ray);
}

std::optional<BrickMap::Crossing> BrickMap::next(const Ray& ray, double from, double to) const {
    constexpr double nudge = 1e-4;  // cells; carries the ray past a cell wall despite rounding
    for (double t = from; t < to;) {
        const dvec3 p = ray.at(t + nudge);
        const glm::ivec3 cell = whole_below(p);
        const bool holds =
            p.x >= 0 && p.y >= 0 && p.z >= 0 && cell.x < cells_.x && cell.y < cells_.y && cell.z < cells_.z;
        bool is_empty = true;
        const double exit =
            std::max(t + nudge, holds ? leaving_empty(cell, ray, is_empty) : leaving(cell, cell + 1, 0, ray));
        if (!is_empty) return Crossing{cell, {t, std::min(exit, to)}};
        t = exit;
    }
    return std::nullopt;
}

}  // namespace lamella
