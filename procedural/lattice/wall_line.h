// WallLine: the distance from the surface of a TpmsWall along one line, tabulated over a period.
#pragma once

#include <array>
#include <vector>

#include "procedural/lattice/wall_plane.h"

namespace lamella {

/// One line of a wall. Bounds along it cost little, for any thickness: between tabulated points the signed
/// distance is a cubic Hermite piece, with an error below 1e-4 radians. Where the nearest point of the
/// surface may not be the only one, they are searched for, which is slow.
class WallLine {
  public:
    /// The line of the plane in the direction `axis`, at an angle in turns across it. The plane has to
    /// outlive the object.
    WallLine(const WallPlane& plane, Axis axis, double across);

    /// Returns what TpmsWall::bound() does at an angle in turns along the line.
    double bound(double turns, double half) const;
    /// Whether bound() certainly rises, or falls, all the way between two angles in turns, first the lower
    /// one, where the half thickness changes by `change` per radian at most.
    bool is_monotone(double from, double to, double change) const;
    /// Finds the turns, ascending and within [-1, 1], in which one period lies in the wall; one infinite
    /// interval if all of it does. Wall and openings thinner than 1/224 of the period may be missed.
    void find_runs(double half, std::vector<Interval>& out) const;

  private:
    /// As in a plane.
    struct Node {
        double distance = 0, slope = 0;
        bool known = false;
    };
    static constexpr int parts = WallPlane::parts;

    void find_slopes();
    double untabulated(double turns, double half, double least) const;
    double bound_at(std::size_t node, double half) const;
    void find_crossings(Interval turns, Interval values, double half, int depth,
                        std::vector<double>& crossings) const;
    double crossing(Interval turns, Interval values, double half) const;

    const WallPlane* plane_;
    Axis axis_;
    SineCosine across_;
    std::array<Node, parts + 1> nodes_;
    std::array<double, parts> slopes_;  ///< least slope of a piece, per step; 0 if it rises and falls
};

}  // namespace lamella
