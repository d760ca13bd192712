// Densities from ratios, and ratios from densities by bisection.
#include "recipe/structure/optimized_foam.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/elasticity/cut_cells.h"
#include "procedural/grading/region_grading.h"
#include "recipe/base_material.h"
#include "recipe/build/build_foam.h"
#include "recipe/build/foam_modulus.h"
#include "recipe/recipe_formulas.h"

namespace lamella {

namespace {

constexpr double least_foam_modulus = 1e-6;

const GradedNumber& constant_number(const GradedNumber& number, const char* key) {
    if (!number.is_formula() && number.number() > 0) return number;
    throw InputError(
        fmt::format("{}: a formula or nothing is given, and the optimisation drives the foam's other "
                    "number; accepted: a length",
                    number.where.empty() ? key : number.where));
}

bool has_walls_alone(const FoamRecipe& foam) { return member_of(foam) == "wall"; }
const char* member_key(const FoamRecipe& foam) { return has_walls_alone(foam) ? "foam.wall" : "foam.beam"; }
const GradedNumber& member_number(const FoamRecipe& foam) {
    return has_walls_alone(foam) ? foam.wall : foam.beam;
}
Interval member_limits(const FoamRecipe& foam) {
    return has_walls_alone(foam) ? Interval{foam.wall_min, foam.wall_max}
                                 : Interval{foam.beam_min, foam.beam_max};
}

}  // namespace

OptimizedFoam::OptimizedFoam(const Recipe& recipe, Gradings& gradings) : recipe_(*recipe.foam) {
    drives_cells_ = recipe.optimize->result == OptimizeResult::cell;
    IsotropicMaterial material;
    if (recipe.material) material = base_material(*recipe.material).elastic;
    material_poisson_ = material.poisson;
    const std::optional<FoamLawTable> table = known_law(recipe_);
    if (!table)
        throw InputError(
            fmt::format("optimize.result: there is no stiffness law for this foam ({}); accepted: "
                        "foam.law / --foam-law with a file that `lamella homogenize --table` writes for it",
                        law_name(recipe_)));
    laws_.push_back(law_of(*table));
    whole_.other = drives_cells_ ? constant_number(member_number(recipe_), member_key(recipe_)).number()
                                 : constant_number(recipe_.cell, "foam.cell").number();
    whole_.driven = drives_cells_ ? Interval{recipe_.cell_min, recipe_.cell_max} : member_limits(recipe_);
    whole_.searched = whole_.driven;
    set_densities(whole_);
    if (!(whole_.ratios.lo < whole_.ratios.hi))
        throw InputError(
            "optimize.result: the limits of cells and members leave the foam no range of densities; "
            "accepted: wider limits (foam.cell_min, cell_max, beam_min, beam_max)");
    const double middle = 0.5 * (whole_.densities.lo + whole_.densities.hi);
    poisson_ = laws_.front().foam->at(ratio_for(middle, whole_)).poisson;
    read_regions(gradings);
}

OptimizedFoam::Law OptimizedFoam::law_of(const FoamLawTable& table) const {
    Law law;
    law.foam = std::make_unique<FoamLaw>(table, material_poisson_);
    law.modulus = make_foam_modulus_law(*law.foam, least_foam_modulus);
    return law;
}

/// Makes the foam's numbers as the build of the foam does.
void OptimizedFoam::read_regions(Gradings& gradings) {
    const bool is_closed = builder_of(recipe_).traits.is_closed;
    const std::string member = member_key(recipe_), driven = drives_cells_ ? "foam.cell" : member;
    const std::string other = drives_cells_ ? member : "foam.cell";
    bool changes_shape = false;
    for (const std::string key : {"foam.cell", "foam.beam", "foam.wall", "foam.window"}) {
        const auto numbers = gradings.overrides(key);
        regional_.insert(regional_.end(), numbers.begin(), numbers.end());
        changes_shape = changes_shape || (is_closed && key != "foam.cell" && !numbers.empty());
    }
    has_regions_ = !regional_.empty();
    if (!has_regions_) return;
    const Interval cells{recipe_.cell_min, recipe_.cell_max}, members = member_limits(recipe_);
    other_ = drives_cells_ ? graded(other, member_number(recipe_), members, gradings).made
                           : graded(other, recipe_.cell, cells, gradings).made;
    std::map<std::string, GradingPtr> names;
    if (!drives_cells_) names.emplace(cell_name, other_);
    const auto at_limit = [&](double limit) {
        return graded(driven, GradedNumber{limit, ""}, whole_.driven, gradings, names).made;
    };
    least_ = at_limit(whole_.driven.lo);
    greatest_ = at_limit(whole_.driven.hi);
    if (!changes_shape) return;
    wall_ = graded("foam.wall", recipe_.wall, {recipe_.wall_min, recipe_.wall_max}, gradings).made;
    window_ = graded("foam.window", recipe_.window, {0, 1}, gradings).made;
}

std::vector<std::shared_ptr<const ModulusLaw>> OptimizedFoam::laws() const {
    std::vector<std::shared_ptr<const ModulusLaw>> laws;
    for (const Law& law : laws_) laws.push_back(law.modulus);
    return laws;
}

/// Returns the foam of the recipe with these beams, walls and windows.
FoamRecipe OptimizedFoam::shaped(const Shape& shape) const {
    FoamRecipe foam = recipe_;
    foam.beam.value = std::get<0>(shape);
    foam.wall.value = std::get<1>(shape);
    foam.window.value = std::get<2>(shape);
    return foam;
}

void OptimizedFoam::set_law(const Shape& shape, FoamRange& range) {
    const auto [found, is_new] = law_of_shape_.emplace(shape, std::nullopt);
    if (is_new) {
        const FoamRecipe foam = shaped(shape);
        if (law_name(foam) == law_name(recipe_)) {
            found->second = 0;
        } else if (const std::optional<FoamLawTable> table = known_law(foam)) {
            found->second = laws_.size();
            laws_.push_back(law_of(*table));
        }
    }
    range.has_law = found->second.has_value();
    range.law = found->second.value_or(0);
}

/// Returns the ratios that cells and members allow, whether the law knows them or not.
Interval OptimizedFoam::asked_ratios(const FoamRange& range) const {
    return drives_cells_ ? Interval{range.other / range.driven.hi, range.other / range.driven.lo}
                         : Interval{range.driven.lo / range.other, range.driven.hi / range.other};
}

void OptimizedFoam::set_densities(FoamRange& range) const {
    const FoamLaw& law = *laws_[range.law].foam;
    const Interval known = law.ratios(), asked = asked_ratios(range);
    range.ratios = {std::max(known.lo, asked.lo), std::min(known.hi, asked.hi)};
    range.densities = {law.at(range.ratios.lo).density, law.at(range.ratios.hi).density};
}

/// Returns the driven numbers with which the foam has these ratios.
Interval OptimizedFoam::numbers_within(Interval ratios, double other) const {
    return drives_cells_ ? Interval{other / ratios.hi, other / ratios.lo}
                         : Interval{other * ratios.lo, other * ratios.hi};
}

/// Where a region's blend leaves a share of the driven number to the search, lets the search choose among
/// numbers that the foam would have without the region: with a small share, nearly all numbers would do.
void OptimizedFoam::apply_regions(FoamRange& range) const {
    constexpr double least_share = 1e-3;
    const double share = range.driven.width() / whole_.driven.width();
    if (share == 1) return;
    const double added = range.driven.lo - share * whole_.driven.lo;
    range.is_kept = share < least_share;
    if (range.is_kept) {
        range.driven.hi = range.driven.lo;
        return;
    }
    const Interval known = numbers_within(laws_[range.law].foam->ratios(), range.other);
    const Interval within{std::max(known.lo, whole_.driven.lo), std::min(known.hi, whole_.driven.hi)};
    if (within.lo < within.hi) range.searched = within;
    range.driven = {added + share * range.searched.lo, added + share * range.searched.hi};
}

std::vector<FoamRange> OptimizedFoam::ranges_at(std::span<const dvec3> places) {
    std::vector<FoamRange> ranges(places.size(), whole_);
    if (!has_regions_) return ranges;
    std::vector<Shape> shapes(wall_ ? places.size() : 0);
    parallel_for(places.size(), [&](std::size_t i) {
        const dvec3 p = places[i];
        FoamRange& range = ranges[i];
        range.other = other_->at(p);
        range.driven = {least_->at(p), greatest_->at(p)};
        if (wall_) shapes[i] = {range.other, wall_->at(p), window_->at(p)};
    });
    for (std::size_t i = 0; i < shapes.size(); ++i) set_law(shapes[i], ranges[i]);
    parallel_for(places.size(), [&](std::size_t i) {
        FoamRange& range = ranges[i];
        apply_regions(range);
        set_densities(range);
        if (!range.is_kept) return;
        const double middle = 0.5 * (range.densities.lo + range.densities.hi);
        range.densities = {middle, middle};
    });
    return ranges;
}

std::size_t OptimizedFoam::law_below_face(const FoamRange& range, Interval depths) {
    constexpr double depth_steps_a_cell = 256, steps_of_other = 64;
    const double depth_step = largest_cell(whole_) / depth_steps_a_cell,
                 other_step = whole_.other / steps_of_other;
    const std::array<long, 3> key{std::lround(depths.lo / depth_step), std::lround(depths.hi / depth_step),
                                  std::lround(range.other / other_step)};
    const auto [found, is_new] = law_of_depth_.emplace(key, laws_.size());
    if (!is_new) return found->second;
    const auto rounded = [&](std::size_t i, double step) { return step * static_cast<double>(key[i]); };
    const Interval below{rounded(0, depth_step), rounded(1, depth_step)};
    const double other = rounded(2, other_step);
    FoamLawTable table{law_name(recipe_), laws_.front().foam->points()};
    for (FoamLawPoint& point : table.points) {
        point.young *= cut_cells_share(below, drives_cells_ ? other / point.ratio : other, point.ratio);
        point.low_factor = point.high_factor = 1;  // the points are the material's already
    }
    laws_.push_back(law_of(table));
    return found->second;
}

/// Returns the key of the last region whose number counts at a place.
std::string OptimizedFoam::region_at(dvec3 place) const {
    std::string where = "region";
    for (const RegionalNumber& number : regional_) {
        if (region_weight(number.region->value(place), number.blend) > 0) where = number.number.where;
    }
    return where;
}

void OptimizedFoam::check(const FoamRange& range, dvec3 place) const {
    if (!range.has_law)
        throw InputError(fmt::format(
            "{}: there is no stiffness law for the foam of this region ({}); accepted: foam.law / --foam-law "
            "with a file that `lamella homogenize --table` writes for it, or no such region",
            region_at(place), law_name(shaped({range.other, wall_->at(place), window_->at(place)}))));
    constexpr double rounding = 1e-9;
    const Interval asked = asked_ratios(range), known = laws_[range.law].foam->ratios();
    if (asked.hi >= known.lo * (1 - rounding) && asked.lo <= known.hi * (1 + rounding) &&
        (range.is_kept || range.ratios.lo < range.ratios.hi))
        return;
    throw InputError(fmt::format(
        "{}: gives the foam members of {:.4g} to {:.4g} of its cells, for which its stiffness law is not "
        "known; accepted: numbers that give {:.4g} to {:.4g}",
        region_at(place), asked.lo, asked.hi, known.lo, known.hi));
}

void OptimizedFoam::check_volume(double share, Interval shares) const {
    if (share > shares.lo && share < shares.hi) return;
    throw InputError(fmt::format(
        "optimize.volume / --optimize-volume: {:.4g} is not a mean density of this part and its foam; "
        "accepted: above {:.4g} and below {:.4g}",
        share, shares.lo, shares.hi));
}

double OptimizedFoam::ratio_for(double density, const FoamRange& range) const {
    const FoamLaw& law = *laws_[range.law].foam;
    double low = range.ratios.lo, high = range.ratios.hi;
    constexpr int halvings = 50;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (law.at(middle).density < density ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double OptimizedFoam::number_for(double density, const FoamRange& range) const {
    const double ratio = ratio_for(density, range);
    const double number = drives_cells_ ? range.other / ratio : range.other * ratio;
    const Interval &to = range.searched, &from = range.driven;
    if (range.is_kept || (from.lo == to.lo && from.hi == to.hi)) return number;
    // Regions are linear in the number that they change.
    return to.lo + std::clamp((number - from.lo) / from.width(), 0.0, 1.0) * to.width();
}

std::vector<dvec3> element_centres(glm::ivec3 size, const Box& box) {
    constexpr double steps_a_mm = 1 << 20;
    std::vector<dvec3> centres;
    const dvec3 edge = box.size() / dvec3(size);
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const dvec3 p = box.lo + (dvec3(x, y, z) + 0.5) * edge;
                centres.push_back(glm::round(p * steps_a_mm) / steps_a_mm);
            }
        }
    }
    return centres;
}

}  // namespace lamella
