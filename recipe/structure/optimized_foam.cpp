// Densities from ratios, and ratios from densities by bisection.
#include "recipe/structure/optimized_foam.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"
#include "recipe/base_material.h"
#include "recipe/build/build_foam.h"
#include "recipe/build/foam_modulus.h"

namespace lamella {

namespace {

constexpr double void_modulus = 1e-6;

const GradedNumber& constant_number(const GradedNumber& number, const char* key) {
    if (!number.is_formula() && number.number() > 0) return number;
    throw InputError(
        fmt::format("{}: a formula or nothing is given, and the optimisation drives the foam's other "
                    "number; accepted: a length",
                    number.where.empty() ? key : number.where));
}

}  // namespace

OptimizedFoam::OptimizedFoam(const Recipe& recipe) {
    const FoamRecipe& foam = *recipe.foam;
    drives_cells_ = recipe.optimize->result == OptimizeResult::cell;
    const bool walls = member_of(foam) == "wall";
    const GradedNumber& member = walls ? foam.wall : foam.beam;
    const Interval members =
        walls ? Interval{foam.wall_min, foam.wall_max} : Interval{foam.beam_min, foam.beam_max};
    IsotropicMaterial material;
    if (recipe.material) material = base_material(*recipe.material).elastic;
    const std::optional<FoamLawTable> table = known_law(foam);
    if (!table)
        throw InputError(
            fmt::format("optimize.result: there is no stiffness law for this foam ({}); accepted: "
                        "foam.law / --foam-law with a file that `lamella homogenize --table` writes for it",
                        law_name(foam)));
    foam_ = std::make_unique<FoamLaw>(*table, material.poisson);
    modulus_ = make_foam_modulus_law(*foam_, void_modulus);
    ratios_ = foam_->ratios();
    if (drives_cells_) {
        other_ = constant_number(member, walls ? "foam.wall" : "foam.beam").number();
        ratios_ = {std::max(ratios_.lo, other_ / foam.cell_max),
                   std::min(ratios_.hi, other_ / foam.cell_min)};
    } else {
        other_ = constant_number(foam.cell, "foam.cell").number();
        ratios_ = {std::max(ratios_.lo, members.lo / other_), std::min(ratios_.hi, members.hi / other_)};
    }
    if (!(ratios_.lo < ratios_.hi))
        throw InputError(
            "optimize.result: the limits of cells and members leave the foam no range of densities; "
            "accepted: wider limits (foam.cell_min, cell_max, beam_min, beam_max)");
    densities_ = {foam_->at(ratios_.lo).density, foam_->at(ratios_.hi).density};
    poisson_ = foam_->at(ratio_for(0.5 * (densities_.lo + densities_.hi))).poisson;
}

void OptimizedFoam::check_volume(double share, Interval shares) const {
    if (share > shares.lo && share < shares.hi) return;
    throw InputError(fmt::format(
        "optimize.volume / --optimize-volume: {:.4g} is not a mean density of this part and its foam; "
        "accepted: above {:.4g} and below {:.4g}",
        share, shares.lo, shares.hi));
}

double OptimizedFoam::ratio_for(double density) const {
    double low = ratios_.lo, high = ratios_.hi;
    constexpr int halvings = 50;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (foam_->at(middle).density < density ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double OptimizedFoam::number_for(double density) const {
    const double ratio = ratio_for(density);
    return drives_cells_ ? other_ / ratio : other_ * ratio;
}

}  // namespace lamella
