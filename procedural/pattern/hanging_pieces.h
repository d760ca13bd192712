// HangingPieces: where a pattern through the thickness of a skin begins in the air when it is printed upward.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/field/field.h"
#include "procedural/pattern/carried_distance.h"
#include "procedural/texture/surface_sites.h"

namespace lamella {

/// Upright lines through a skin, a spacing of the sites apart along x and y. Immutable.
class HangingPieces {
  public:
    /// Sites of a body's surface, which have to outlive the object; `depth` is the skin's thickness, mm.
    HangingPieces(const SurfaceSites& sites, const Field& body, double depth);

    /// Returns the lowest point of each piece of the solid that hangs, the lowest first, as numbers of
    /// samples: it begins higher than the part does, by more than a fiftieth of a spacing, and stays alone
    /// for more than a quarter of one of height before it joins a piece that began lower. `pattern` is that
    /// of the sites, mm, positive in the solid.
    std::vector<std::uint32_t> find(const CarriedDistance& pattern) const;

    /// The site nearest to a sample.
    std::uint32_t site(std::uint32_t sample) const { return samples_[sample].site; }

    /// Returns the sites along the shortest way through the skin, from the lowest sample of a piece to solid
    /// that is lower, by a spacing if there is such, or else begins lower. The way rises only where it has
    /// to, and at most two spacings above the sample. Empty if there is none, or if all of it is solid.
    std::vector<std::uint32_t> way_down(const CarriedDistance& pattern, std::uint32_t sample) const;

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
        std::uint32_t sample;  ///< the first in it
    };
    /// Two intervals side by side, the height from which they are joined, and up to which they lie beside
    /// each other, mm.
    struct Joint {
        double height, end;
        std::uint32_t a, b;
    };

    const Sample* sample_at(glm::i64vec3 at) const;
    double value(const CarriedDistance& pattern, const Sample& sample) const;
    double begin_of(const CarriedDistance& pattern, std::uint32_t sample) const;
    template <typename IsTarget>
    std::vector<std::uint32_t> way_to(const CarriedDistance& pattern, std::uint32_t sample,
                                      const IsTarget& is_target) const;
    std::vector<std::uint32_t> strut_along(const CarriedDistance& pattern,
                                           const std::unordered_map<std::uint32_t, std::uint32_t>& from,
                                           std::uint32_t end) const;
    std::vector<Interval> intervals_of(const CarriedDistance& pattern) const;
    static std::vector<Joint> neighbours_of(std::span<const Interval> intervals);
    bool is_solid_between(const CarriedDistance& pattern, const Interval& a, const Interval& b,
                          double height) const;
    std::vector<Joint> joints_of(const CarriedDistance& pattern, std::span<const Interval> intervals) const;

    const SurfaceSites& sites_;
    std::vector<Sample> samples_;  ///< by y, x, z
};

}  // namespace lamella
