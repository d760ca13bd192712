// CombinedSlice: the union or intersection of two slices of one plane.
#pragma once

#include "engine/field/field.h"

namespace lamella {

/// The union (either) or the intersection (both).
enum class Combine : unsigned char { either, both };

class CombinedSlice : public SliceField {
  public:
    CombinedSlice(const SliceField& a, const SliceField& b, Combine how) : a_(a), b_(b), how_(how) {}

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override;
    Interval range(const Rect& r) const override;
    void sample(const Tile& tile, std::span<float> out) const override;
    Rect bounds() const override;

  private:
    const SliceField& a_;
    const SliceField& b_;
    Combine how_;
};

}  // namespace lamella
