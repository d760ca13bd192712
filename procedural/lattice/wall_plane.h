// WallPlane: the distance from the surface of a TpmsWall in one plane, tabulated over a period.
#pragma once

#include <vector>

#include "procedural/lattice/tpms_wall.h"

namespace lamella {

/// The signed distances in a plane z at parts x parts nodes, with their first derivatives and the mixed one.
/// Between four known nodes they are a bicubic Hermite patch, with an error below 1e-4 radians.
class WallPlane {
  public:
    static constexpr int parts = 56;
    static constexpr double step = 2 * pi / parts;  // radians

    /// Derivatives are those per step.
    struct Node {
        double distance = 0;  ///< if it is not known, a lower bound of its magnitude
        double along_x = 0, along_y = 0, mixed = 0;
        bool known = false;  ///< where the nearest point of the surface is known to be the only one
    };

    /// The plane at the angle z of the wall, which has to outlive the object.
    WallPlane(const TpmsWall& wall, const SineCosine& z);

    const TpmsWall& wall() const { return wall_; }
    const SineCosine& z() const { return z_; }
    /// The node at x = i steps, y = j steps; 0 <= i, j <= parts.
    const Node& node(int i, int j) const {
        return nodes_[static_cast<std::size_t>(j % parts) * parts + static_cast<std::size_t>(i % parts)];
    }

  private:
    const TpmsWall& wall_;
    SineCosine z_;
    std::vector<Node> nodes_;  ///< row by row
};

}  // namespace lamella
