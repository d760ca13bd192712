// PlaneRuns: where the lines of a plane meet two solids.
#pragma once

#include "engine/field/field.h"
#include "engine/field/slice_context.h"

namespace lamella {

/// The part and, or null for none, a second solid (supports or faults), which matters outside the part.
struct TwoSolids {
    FieldPtr part, second;
};

/// Reused from plane to plane. Not thread-safe.
class PlaneRuns {
  public:
    /// Takes the runs of both solids on the lines of a band, clipped to the bounds.
    void cut(const TwoSolids& solids, SliceContext& context, double height, const RowBand& band,
             const Rect& bounds);
    const RunRows& part() const { return part_; }
    const RunRows& all() const { return has_second_ ? all_ : part_; }

  private:
    Scratch scratch_;
    bool has_second_ = false;
    RunRows whole_, part_, second_, all_;
};

}  // namespace lamella
