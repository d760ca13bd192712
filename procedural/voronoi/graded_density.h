// The density of seeds that gives cells of a graded size.
#pragma once

#include "engine/field/grading.h"
#include "procedural/voronoi/density.h"

namespace lamella {

/// One seed per cell^3, the cell's size being a grading, mm. The integral over a box reads the size at its
/// centre; where the size may change by more than 5 % within the box, at the centres of its eight octants.
class GradedDensity : public Density {
  public:
    /// The sizes must be positive everywhere.
    explicit GradedDensity(GradingPtr cell) : cell_(std::move(cell)) {}
    Interval range(const Box& box) const override;
    double integral(const Box& box) const override;
    void integrals(std::span<const Box> boxes, std::span<double> out) const override;

  private:
    GradingPtr cell_;
};

}  // namespace lamella
