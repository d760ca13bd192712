// PolygonSlice: the interior of polygons as a slice.
#pragma once

#include <span>
#include <vector>

#include "engine/field/field.h"

namespace lamella {

/// The points of the plane that an odd number of closed polygons encloses. Values are distances to the
/// nearest side, mm.
class PolygonSlice : public SliceField {
  public:
    /// Polygons come without repeated last points, in any order and orientation; mm, finite.
    explicit PolygonSlice(std::span<const std::vector<dvec2>> polygons);

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override;
    Interval range(const Rect& r) const override;
    void sample(const Tile& tile, std::span<float> out) const override;
    Rect bounds() const override { return bounds_; }

  private:
    struct Side {
        dvec2 a, b;
    };
    double value(dvec2 p) const;

    std::vector<Side> sides_;
    Rect bounds_;
};

}  // namespace lamella
