// TpmsWall: which points lie closer to a surface g = 0 than half a wall's thickness. Distances and
// thicknesses are in radians of the angles.
#pragma once

#include <optional>

#include "procedural/lattice/tpms_surface.h"

namespace lamella {

/// Walls of any thickness along one surface.
///
/// Two bounds of the distance d of a point from the surface need no search. With L for the maximum second
/// derivative, |g| <= |grad g| d + L d^2 / 2, and the surface is met along the gradient within the smaller
/// root of |g| = |grad g| d - L d^2 / 2. Between them, the nearest point of the surface is found by Newton's
/// method for the conditions g = 0 and offset + multiplier grad g = 0.
class TpmsWall {
  public:
    explicit TpmsWall(TpmsKind kind);

    /// Returns a bound of the signed distance to the wall of half thickness `half`: negative inside, and
    /// exact there and nearby. It changes by at most 1 per radian.
    double value(const TpmsPoint& point, double half) const;
    /// Returns a bound of the same sign that is faster to compute, but jumps.
    double bound(const TpmsPoint& point, double half) const;
    /// The distance from the surface, with the sign of g, and the nearest point.
    struct Nearest {
        double distance;
        dvec3 normal;        ///< the direction in which the distance grows: its gradient
        glm::dmat3 hessian;  ///< the second derivatives of the distance
        dvec3 foot;          ///< the surface's nearest point, from the point
    };
    /// Returns these where the nearest point of the surface is known to be the only one; elsewhere the
    /// distance is at least about radius_of_uniqueness(). The search may begin near the nearest point of a
    /// point beside, `start` from this one.
    std::optional<Nearest> signed_distance(const TpmsPoint& point, std::optional<dvec3> start) const;
    /// Returns a lower bound of the distance from the surface where signed_distance() returns nothing.
    double least_distance(const TpmsPoint& point) const;
    /// The distance below which a point of space has one nearest point, which the search finds; measured.
    double radius_of_uniqueness() const { return sole_; }
    /// Returns bounds of the values over a box of angles, for all half thicknesses of an interval.
    Interval range(const Box& angles, Interval half) const;

  private:
    /// The value where the bounds leave it open. `exact` asks for that of value(), else for one of bound().
    double nearest(const TpmsPoint& point, const TpmsSample& sample, double half, bool exact) const;
    /// Moves `offset` from the point to a nearest point of the surface, by Newton's method from where it
    /// starts. Returns its length less `half`, or a number of the same sign nearer to zero unless `exact`;
    /// infinity if the method fails.
    double search(const TpmsPoint& point, dvec3& offset, double half, bool exact) const;

    TpmsKind kind_;
    TpmsConstants g_;
    double sole_;  ///< radians; the search finds the nearest point of the surface for all points nearer than
                   ///< this
};

}  // namespace lamella
