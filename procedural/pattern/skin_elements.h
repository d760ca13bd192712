// SkinElements: a patterned skin as finite elements.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/cancel_token.h"
#include "engine/field/field.h"
#include "procedural/texture/surface_sites.h"

namespace lamella {

/// Cubes over a skin; each knows the sites nearest to points of the skin inside it. Immutable.
class SkinElements {
  public:
    static constexpr std::uint32_t none = 0xffffffff;

    /// The sites have to outlive the object. `shell` is the skin without a pattern, at most `depth` mm below
    /// the surface of the sites; `edge` (mm) is that of the cubes. Throws InputError for more than 30 million
    /// cubes in the skin's box, Interrupted when cancelled.
    SkinElements(const Field& shell, const SurfaceSites& sites, double depth, double edge,
                 const CancelToken* cancel);

    glm::ivec3 size() const { return size_; }
    const Box& box() const { return box_; }
    double edge() const { return edge_; }
    /// Returns by cube, x fastest, the share of it that is solid, given the distances of a pattern (mm,
    /// positive in the solid, by site); without any, that of the closed skin.
    std::vector<float> shares(std::span<const float> distances) const;
    /// Returns by site the cube with the largest share among those that it is a nearest site in, or else that
    /// a neighbour is; `none` where there is none with a share of at least `least`.
    std::vector<std::uint32_t> cubes_of_sites(std::span<const float> shares, double least) const;

  private:
    static constexpr int points_along = 2;
    static constexpr double points_in_a_cube = points_along * points_along * points_along;

    const SurfaceSites& sites_;
    glm::ivec3 size_{0};
    Box box_;
    double edge_;
    std::vector<std::uint32_t> cubes_;    ///< those that the skin touches
    std::vector<std::uint32_t> first_;    ///< of each of them in `nearest_`, and the end
    std::vector<std::uint32_t> nearest_;  ///< sites, one for each point inside the skin
};

}  // namespace lamella
