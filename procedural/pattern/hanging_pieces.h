// HangingPieces: where a pattern through the thickness of a skin begins in the air when it is printed upward.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "procedural/texture/surface_sites.h"

namespace lamella {

/// Upright lines through a skin, a spacing of the sites apart along x and y. Immutable.
class HangingPieces {
  public:
    /// Sites have to outlive the object; `depth` is the skin's thickness, mm.
    HangingPieces(const SurfaceSites& sites, double depth);

    /// Returns the site nearest to the lowest point of each piece of the solid that hangs, the lowest first:
    /// it begins higher than the part does, and stays alone for more than a quarter of a spacing of height
    /// before it joins a piece that began lower. `distances` are those of the pattern at the sites, mm,
    /// positive in the solid.
    std::vector<std::uint32_t> find(std::span<const float> distances) const;

  private:
    /// A sample on a line.
    struct Sample {
        glm::i64vec3 at;  ///< in spacings
        std::uint32_t site;
        float depth;  ///< below the nearer surface of the skin, mm; negative outside
    };
    /// The solid of a line between two heights, mm.
    struct Interval {
        std::int64_t x, y;  ///< of the line, in spacings
        double begin, end;
        std::uint32_t site;  ///< nearest to its begin
    };
    /// Two intervals side by side, and the height from which they are joined, mm.
    struct Joint {
        double height;
        std::uint32_t a, b;
    };

    std::vector<Interval> intervals_of(std::span<const float> distances) const;
    static std::vector<Joint> joints_of(std::span<const Interval> intervals);

    const SurfaceSites& sites_;
    std::vector<Sample> samples_;  ///< by y, x, z
};

}  // namespace lamella
