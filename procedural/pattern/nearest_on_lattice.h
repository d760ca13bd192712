// NearestOnLattice: the nearest site of each point of a lattice about a surface.
#pragma once

#include <deque>
#include <unordered_map>
#include <vector>

#include "procedural/texture/lattice_hash.h"
#include "procedural/texture/surface_sites.h"

namespace lamella {

/// The lattice's step is the sites' spacing, and one of its points is the origin. Nearest sites are handed
/// from point to point, and are the nearest but for rare cases, in which another one is nearly as near.
/// Immutable.
class NearestOnLattice {
  public:
    static constexpr std::uint32_t none = 0xffffffff;

    /// Finds the nearest sites of points within `depth` mm of one, and at most `height` mm above its surface;
    /// those in the last step may have none.
    NearestOnLattice(const SurfaceSites& sites, double depth, double height);

    /// Returns the nearest site of a point, in steps of the lattice; `none` beyond the depth.
    std::uint32_t site(glm::i64vec3 at) const;
    /// The same, quicker for points near each other: `hint` carries the last point's brick to the next.
    std::uint32_t site(glm::i64vec3 at, std::size_t& hint) const;
    /// Returns the lowest points, over 8, of the bricks of 8 x 8 x 8 points in which some point has a site.
    std::vector<glm::i64vec3> bricks() const;

  private:
    static constexpr int side = 8;
    static constexpr std::size_t brick_points = 512;
    struct Brick {
        glm::i64vec3 corner{0};
        std::vector<std::uint32_t> sites;  ///< x fastest
    };

    std::uint32_t& stored(glm::i64vec3 at);
    void descend(Brick& brick) const;
    double square(glm::i64vec3 at, std::uint32_t site) const;
    void propose(glm::i64vec3 at, std::uint32_t site);

    const SurfaceSites& sites_;
    double square_;  ///< of the depth
    double height_;
    std::vector<Brick> bricks_;
    std::unordered_map<glm::i64vec3, std::size_t, LatticeHash> numbers_;
    std::size_t last_ = 0;
    std::deque<glm::i64vec3> open_;
};

}  // namespace lamella
