// SupportPlacer: places support points and answers what they hold.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "engine/field/field.h"
#include "engine/surveys/support_point.h"

namespace lamella {

/// A hash grid of points, with cells as large as the search radius. Results do not depend on the order of
/// cells.
class PointCells {
  public:
    explicit PointCells(double size) : size_(size) {}
    void add(dvec3 p);
    /// Returns true if a point lies within the cell size of p and not above it.
    bool any_below(dvec3 p) const;

  private:
    double size_;
    std::unordered_map<std::uint64_t, std::vector<dvec3>> cells_;
};

/// Collects support points. Points in a blocked region are left out and counted; they count as holding
/// blocked places only.
class SupportPlacer {
  public:
    /// `spacing` in mm; `blocked` may be null.
    SupportPlacer(double spacing, FieldPtr blocked);

    /// Returns true if a point holds p: it lies within the spacing of p and not above it.
    bool held(dvec3 p) const;
    bool blocked(dvec3 p) const { return blocked_ && blocked_->value(p) < 0; }
    /// Places a point. Returns false if the place is blocked.
    bool place(dvec3 p, SupportReason reason);

    const std::vector<SupportPoint>& points() const { return points_; }
    std::size_t left_out() const { return left_out_; }

  private:
    FieldPtr blocked_;
    PointCells placed_, missing_;
    std::vector<SupportPoint> points_;
    std::size_t left_out_ = 0;
};

}  // namespace lamella
