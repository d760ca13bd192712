// BrickMap: a set of grid cells, one bit each, that rays cross in steps as wide as the empty space allows.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Bits of 4 x 4 x 4 cells, a brick, share a word. Each empty brick knows the distance to the nearest one
/// with a cell of the set. Positions are in cells.
class BrickMap {
  public:
    /// Layers of cells that share words: different threads fill different slabs.
    static constexpr int slab = 4;

    explicit BrickMap(glm::ivec3 cells);

    void insert(int x, int y, int z) { words_[at(x >> 2, y >> 2, z >> 2)] |= bit(x, y, z); }
    /// Finds the distances; called once after all cells are inserted.
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
    std::size_t at(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(bricks_.y) +
                static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(bricks_.x) +
               static_cast<std::size_t>(x);
    }
    static std::uint64_t bit(int x, int y, int z) {
        return std::uint64_t{1} << ((x & 3) | (y & 3) << 2 | (z & 3) << 4);
    }
    static int empty_in(std::uint64_t word, glm::ivec3 cell);
    double leaving_empty(glm::ivec3 cell, const Ray& ray, bool& is_empty) const;

    glm::ivec3 cells_, bricks_;
    std::vector<std::uint64_t> words_;
    std::vector<std::uint8_t>
        far_;  ///< bricks to the nearest that is not empty, along the axis where it is most
};

}  // namespace lamella
