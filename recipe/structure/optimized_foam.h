// OptimizedFoam: the foam whose cells or beams an optimisation drives.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "procedural/optimization/modulus_law.h"
#include "recipe/build/build_gradings.h"

namespace lamella {

/// What the foam of a place can be.
struct FoamRange {
    std::size_t law = 0;   ///< its place in OptimizedFoam::laws()
    bool has_law = true;   ///< if not, that of the foam without regions stands in
    double other = 0;      ///< the number that is not driven, mm
    Interval searched;     ///< of the driven number before regions are applied, mm
    Interval driven;       ///< of the driven number with regions applied, mm
    Interval ratios;       ///< of members to cells, as far as the law knows them
    Interval densities;    ///< solid volume fractions at their ends
    bool is_kept = false;  ///< regions set the driven number
};

/// Densities that the foam of a recipe can have, and the member-to-cell ratio that gives each. Inside foam
/// regions the numbers are theirs: another number that is not driven changes the densities there, a driven
/// one sets it, and closed cells of another proportion have another law.
class OptimizedFoam {
  public:
    /// Takes the foam regions from the gradings. Throws InputError when the foam has no law, or its other
    /// number is a formula.
    OptimizedFoam(const Recipe& recipe, Gradings& gradings);

    const std::shared_ptr<const ModulusLaw>& law() const { return laws_.front().modulus; }
    /// That of the foam without regions, and those of the places and depths that were asked for.
    std::vector<std::shared_ptr<const ModulusLaw>> laws() const;
    /// Solid volume fractions of the sparsest and the densest foam within the limits of cells and beams,
    /// without regions.
    Interval densities() const { return whole_.densities; }
    /// Poisson's ratio of the foam without regions in the middle of its range; it stands for all elements.
    double poisson() const { return poisson_; }
    /// Throws InputError unless the mean density of the part lies within those that it can have.
    void check_volume(double share, Interval shares) const;

    bool has_regions() const { return has_regions_; }
    /// Returns what the foam can be at each of these places.
    std::vector<FoamRange> ranges_at(std::span<const dvec3> places);
    const FoamRange& without_regions() const { return whole_; }
    /// Returns the place in laws() of that of the foam between two depths (mm) below a bare face, where cut
    /// cells make it softer: see cut_cells_share(). Depths and the number that is not driven are rounded.
    std::size_t law_below_face(const FoamRange& range, Interval depths);
    /// The largest cell of a range, mm.
    double largest_cell(const FoamRange& range) const {
        return drives_cells_ ? range.driven.hi : range.other;
    }
    /// Throws InputError that names the region whose numbers leave the law, or have none.
    void check(const FoamRange& range, dvec3 place) const;
    /// Returns the driven number (foam.cell or foam.beam, mm) that gives a density once regions are applied
    /// to it; outside the range's densities that of the nearest end.
    double number_for(double density, const FoamRange& range) const;

  private:
    struct Law {
        std::unique_ptr<FoamLaw> foam;
        std::shared_ptr<const ModulusLaw> modulus;
    };
    /// Beam, wall and window of closed cells.
    using Shape = std::tuple<double, double, double>;

    Law law_of(const FoamLawTable& table) const;
    void read_regions(Gradings& gradings);
    FoamRecipe shaped(const Shape& shape) const;
    void set_law(const Shape& shape, FoamRange& range);
    Interval asked_ratios(const FoamRange& range) const;
    Interval numbers_within(Interval ratios, double other) const;
    void apply_regions(FoamRange& range) const;
    void set_densities(FoamRange& range) const;
    double ratio_for(double density, const FoamRange& range) const;
    std::string region_at(dvec3 place) const;

    FoamRecipe recipe_;
    double material_poisson_ = 0;
    std::vector<Law> laws_;
    FoamRange whole_;
    double poisson_ = 0;
    bool drives_cells_ = false;

    bool has_regions_ = false;
    GradingPtr other_, least_, greatest_;  ///< the last two: the driven number at its limits, mm
    GradingPtr wall_, window_;             ///< null unless regions may change the law
    std::vector<RegionalNumber> regional_;
    std::map<Shape, std::optional<std::size_t>> law_of_shape_;
    std::map<std::array<long, 3>, std::size_t> law_of_depth_;  ///< depths and the other number, in steps
};

/// Returns the centres of the elements of a grid in a box, x fastest, without the rounding of a box that was
/// read from a file: borders of regions must not move by it.
std::vector<dvec3> element_centres(glm::ivec3 size, const Box& box);

}  // namespace lamella
