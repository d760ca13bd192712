// The density of seeds that gives cells of a graded size.
#pragma once

#include "engine/grading.h"
#include "procedural/density.h"

namespace lamella {

/// One seed per cell^3, the cell's size being a grading, mm. Where the size changes within a box, the
/// integral is taken over parts in which it changes by at most 5 %, or that are half the box wide.
class GradedDensity : public Density {
  public:
    /// The sizes must be positive everywhere.
    explicit GradedDensity(GradingPtr cell) : cell_(std::move(cell)) {}
    Interval range(const Box& box) const override;
    double integral(const Box& box) const override;

  private:
    double integral(const Box& box, int halvings) const;

    GradingPtr cell_;
};

}  // namespace lamella
