// BrickMap: a set of grid cells, one bit each, that rays cross in steps as wide as the empty space allows.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Bits of 4 x 4 x 4 cells share a word; a bit of a word above stands for such a word that is not zero. Three
/// levels: bricks of 4, 16 and 64 cells. Positions are in cells.
class BrickMap {
  public:
    /// Layers of cells that share words: different threads fill different slabs.
    static constexpr int slab = 4;

    explicit BrickMap(glm::ivec3 cells);

    void insert(int x, int y, int z) {
        const std::size_t brick = leaves_.at(x >> 2, y >> 2, z >> 2);
        leaves_.words[brick] |= bit(x, y, z);
    }
    /// Marks the bricks that are not empty; called once after all cells are inserted.
    void finish();

    /// A ray with its reciprocal direction, which traversal needs at every step.
    struct Ray {
        dvec3 start, direction, inverse;
        glm::ivec3 forward;  ///< 1 where the ray leaves a brick by its upper wall, else 0

        Ray(dvec3 from, dvec3 towards);
        dvec3 at(double t) const { return start + direction * t; }
    };
    /// A cell of the set and the interval of the ray inside it.
    struct Crossing {
        glm::ivec3 cell;
        Interval inside;
    };
    /// Returns the first cell of the set on the ray at or after `from`; nothing when `to` comes first.
    std::optional<Crossing> next(const Ray& ray, double from, double to) const;

  private:
    struct Level {
        glm::ivec3 size{0};
        std::vector<std::uint64_t> words;

        explicit Level(glm::ivec3 n);
        std::size_t at(int x, int y, int z) const {
            return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size.y) +
                    static_cast<std::size_t>(y)) *
                       static_cast<std::size_t>(size.x) +
                   static_cast<std::size_t>(x);
        }
    };
    static std::uint64_t bit(int x, int y, int z) {
        return std::uint64_t{1} << ((x & 3) | (y & 3) << 2 | (z & 3) << 4);
    }
    static void mark_above(const Level& below, Level& above);
    static int empty_in(std::uint64_t word, int x, int y, int z);
    int empty_doublings(glm::ivec3 cell) const;

    glm::ivec3 cells_;
    Level leaves_, bricks_, blocks_;  ///< words of 4, 16 and 64 cells
};

}  // namespace lamella
