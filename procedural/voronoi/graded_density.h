// GradedDensity: the density of seeds that gives cells of a graded size.
#pragma once

#include "engine/field/grading.h"
#include "procedural/voronoi/density.h"

namespace lamella {

/// One seed per cell^3, where the cell size (mm) is a grading. The integral over a box samples the size at
/// the box's centre, or, if the size may vary by more than 5 % within the box, at the centres of its eight
/// octants.
class GradedDensity : public Density {
  public:
    /// `cell` must be positive everywhere.
    explicit GradedDensity(GradingPtr cell) : cell_(std::move(cell)) {}
    Interval range(const Box& box) const override;
    double integral(const Box& box) const override;
    void integrals(std::span<const Box> boxes, std::span<double> out) const override;

  private:
    GradingPtr cell_;
};

}  // namespace lamella
