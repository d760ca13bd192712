// WallLine: the distance from the surface of a TpmsWall along one line, tabulated over a period.
#pragma once

#include <array>

#include "procedural/lattice/tpms_wall.h"

namespace lamella {

/// One line of a wall. Many bounds along it, also for different thicknesses, cost little: between tabulated
/// points the signed distance is a cubic Hermite piece, with an error below 1e-4 radians.
class WallLine {
  public:
    /// Half thicknesses up to which a line can be tabulated: the surface's nearest points must be unique.
    static double greatest_half(const TpmsWall& wall) { return wall.radius_of_uniqueness() - step; }

    /// The line in the direction `axis` of a plane, with these angles across it and of the plane's height.
    WallLine(const TpmsWall& wall, Axis axis, const SineCosine& across, const SineCosine& z);

    /// Returns what TpmsWall::bound() does at an angle in turns along the line. `half` is at most
    /// greatest_half().
    double bound(double turns, double half) const;

  private:
    static constexpr int parts = 40;
    static constexpr double step = 2 * pi / parts;  // radians

    struct Node {
        double distance = 0, slope = 0;
        bool known = false;
    };

    const TpmsWall* wall_;
    Axis axis_;
    SineCosine across_, z_;
    std::array<Node, parts + 1> nodes_;
};

}  // namespace lamella
