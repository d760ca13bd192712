// SupportPlacer: support points as they are placed, and what they hold.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "engine/field/field.h"
#include "engine/surveys/support_point.h"

namespace lamella {

/// Points by cells of their spacing. The answers do not depend on the order of the cells.
class PointCells {
  public:
    explicit PointCells(double size) : size_(size) {}
    void add(dvec3 p);
    /// Whether a point lies within the cells' size of p and not above it.
    bool any_below(dvec3 p) const;

  private:
    double size_;
    std::unordered_map<std::uint64_t, std::vector<dvec3>> cells_;
};

/// Takes points as they come, but for those in a blocked region: they are counted, and hold only what is
/// blocked itself.
class SupportPlacer {
  public:
    /// spacing in mm; `blocked` may be null.
    SupportPlacer(double spacing, FieldPtr blocked);

    /// Whether a point within the spacing, not above p, holds p.
    bool held(dvec3 p) const;
    bool blocked(dvec3 p) const { return blocked_ && blocked_->value(p) < 0; }
    /// False where the place is blocked.
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
