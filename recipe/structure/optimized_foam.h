// OptimizedFoam: the foam whose cells or beams an optimisation drives.
#pragma once

#include <memory>

#include "procedural/optimization/modulus_law.h"
#include "recipe/recipe.h"

namespace lamella {

/// Densities that the foam of a recipe can have, and the member-to-cell ratio that gives each.
class OptimizedFoam {
  public:
    /// Throws InputError when the foam has no law, or its other number is a formula.
    explicit OptimizedFoam(const Recipe& recipe);

    const std::shared_ptr<const ModulusLaw>& law() const { return modulus_; }
    /// Solid volume fractions of the sparsest and the densest foam within the limits of cells and beams.
    Interval densities() const { return densities_; }
    /// Poisson's ratio of the foam in the middle of its range.
    double poisson() const { return poisson_; }
    /// Throws InputError unless the mean density of the part lies within those that it can have.
    void check_volume(double share, Interval shares) const;
    /// Returns the driven number (foam.cell or foam.beam, mm) for a density; outside densities() that of the
    /// nearest end.
    double number_for(double density) const;

  private:
    double ratio_for(double density) const;

    std::unique_ptr<FoamLaw> foam_;
    std::shared_ptr<const ModulusLaw> modulus_;
    Interval ratios_, densities_;
    double poisson_ = 0;
    double other_ = 0;  ///< mm: the member if cells are driven, the cell if members are
    bool drives_cells_ = false;
};

}  // namespace lamella
