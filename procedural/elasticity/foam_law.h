// How stiff a foam is by the size of its members, and the members that make it as stiff as wanted.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "procedural/grading/table_curve.h"

namespace lamella {

/// Poisson's ratios of the materials that laws are computed with.
inline constexpr double law_poisson = 1.0 / 3, low_poisson = 0.2, high_poisson = 0.45;

/// What was computed of a foam with members of one size.
struct FoamLawPoint {
    double ratio = 0;    ///< of the members' radius (walls: thickness) to the cell
    double density = 0;  ///< share that is solid
    double young = 0;    ///< over the material's
    double poisson = 0;  ///< of the foam
    /// The foam's modulus with materials of low_poisson and high_poisson, over that with law_poisson.
    double low_factor = 1, high_factor = 1;
    double spread = 0;      ///< of single samples' moduli: standard deviation over mean
    double anisotropy = 0;  ///< of the mean stiffness
    int elements = 0;       ///< along a sample's side
    int samples = 0;
};

/// A foam's law as it is kept: what foam, and its points by rising ratio, for a material with law_poisson.
struct FoamLawTable {
    std::string foam;  ///< in words of its own, without commas
    std::vector<FoamLawPoint> points;
};

/// A foam's stiffness over its material's depends on the ratio of its members to its cells, and a little on
/// the material's Poisson's ratio. Between the points that were computed a monotone cubic runs through the
/// logarithms of modulus and ratio. The same bits on every machine.
class FoamLaw {
  public:
    /// The law for materials of a Poisson's ratio. Throws InputError for fewer than two points, for numbers
    /// out of range, and where ratio and modulus do not grow from point to point.
    FoamLaw(const FoamLawTable& table, double material_poisson);

    /// The ratios that were computed, and the moduli at their ends, over the material's.
    Interval ratios() const { return {points_.front().ratio, points_.back().ratio}; }
    Interval moduli() const { return {points_.front().young, points_.back().young}; }
    /// Of all samples: the root of the mean square of the points' spreads.
    double spread() const;
    /// The ratio whose foam has a modulus, over the material's: beyond moduli() that of its nearest end; NaN
    /// for NaN.
    double ratio_of(double young) const;
    /// What is known of a ratio; beyond ratios() of its nearest end.
    FoamLawPoint at(double ratio) const;

  private:
    std::vector<FoamLawPoint> points_;  // for the material's Poisson's ratio
    TableCurve log_ratio_;              // along the modulus' logarithm
};

/// Reads laws: rows in the columns that law_heading() names, those of one foam in a row. `name` stands in
/// messages. Throws InputError("name:line: what").
std::vector<FoamLawTable> read_foam_laws(std::string_view text, const std::string& name);
std::string law_heading();
/// A row of such a file, with its end.
std::string law_row(const std::string& foam, const FoamLawPoint& point);

}  // namespace lamella
