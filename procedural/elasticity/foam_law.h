// FoamLaw: the relative modulus of a foam as a function of its member-to-cell ratio, and the inverse.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "procedural/grading/table_curve.h"

namespace lamella {

/// Poisson's ratios of the base materials that laws are computed for.
inline constexpr double law_poisson = 1.0 / 3, low_poisson = 0.2, high_poisson = 0.45;

/// Computed properties of a foam at one member-to-cell ratio.
struct FoamLawPoint {
    double ratio = 0;    ///< members' radius (walls: thickness) over cell size
    double density = 0;  ///< solid volume fraction
    double young = 0;    ///< Young's modulus of the foam over the material's
    double poisson = 0;  ///< Poisson's ratio of the foam
    /// The foam's modulus with a material of low_poisson, and of high_poisson, over that with law_poisson.
    double low_factor = 1, high_factor = 1;
    double spread = 0;      ///< of the moduli of single samples: standard deviation over mean
    double anisotropy = 0;  ///< of the mean stiffness; see anisotropy()
    int elements = 0;       ///< along one side of a sample
    int samples = 0;
};

/// A foam's law as stored: the foam's description and the computed points by ascending ratio, for a material
/// with law_poisson.
struct FoamLawTable {
    std::string foam;  ///< description, without commas
    std::vector<FoamLawPoint> points;
};

/// The relative modulus of a foam depends on the ratio of its members to its cells and, slightly, on
/// Poisson's ratio of the material. Between computed points a monotone cubic interpolates log(ratio) over
/// log(modulus). Results have the same bits on every machine.
class FoamLaw {
  public:
    /// Makes the law for materials of one Poisson's ratio. Throws InputError for fewer than two points, for
    /// numbers out of range, and if ratio or modulus does not increase from point to point.
    FoamLaw(const FoamLawTable& table, double material_poisson);

    /// The computed points, for the material's Poisson's ratio.
    const std::vector<FoamLawPoint>& points() const { return points_; }
    /// The range of computed ratios, and the relative moduli at its ends.
    Interval ratios() const { return {points_.front().ratio, points_.back().ratio}; }
    Interval moduli() const { return {points_.front().young, points_.back().young}; }
    /// The root mean square of the points' spreads.
    double spread() const;
    /// Returns the ratio that gives a relative modulus. Outside moduli() returns the ratio of the nearest
    /// end; NaN for NaN.
    double ratio_of(double young) const;
    /// Returns the interpolated properties at a ratio; outside ratios() those of the nearest end.
    FoamLawPoint at(double ratio) const;

  private:
    std::vector<FoamLawPoint> points_;  // for the material's Poisson's ratio
    TableCurve log_ratio_;              // over the logarithm of the modulus
};

/// Reads laws from text. The columns are those of law_heading(); the rows of one foam are contiguous. `name`
/// is the file name in messages. Throws InputError("name:line: what").
std::vector<FoamLawTable> read_foam_laws(std::string_view text, const std::string& name);
std::string law_heading();
/// Returns one row of such a file, including the line end.
std::string law_row(const std::string& foam, const FoamLawPoint& point);

}  // namespace lamella
