// Linear regression of logarithms.
#include "procedural/elasticity/law_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/deterministic_math.h"
#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "procedural/elasticity/elastic_tensor.h"

namespace lamella {
namespace {

/// Quantile of Student's t distribution, 95 % two-sided.
double student_t(std::size_t degrees) {
    constexpr std::array table{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228};
    if (degrees <= table.size()) return table[degrees - 1];
    return 1.96 + 2.4 / static_cast<double>(degrees) + 3.0 / static_cast<double>(degrees * degrees);
}

/// A line fitted by least squares; its slope is 1 unless it can be fitted.
struct Line {
    double slope, level, residual;  // sum of squared residuals
};

Line line_through(std::span<const std::pair<double, double>> points, bool finds_slope) {
    const auto n = static_cast<double>(points.size());
    double x = 0, y = 0, xx = 0, xy = 0;
    for (const auto& [px, py] : points) {
        x += px / n;
        y += py / n;
    }
    for (const auto& [px, py] : points) {
        xx += (px - x) * (px - x);
        xy += (px - x) * (py - y);
    }
    Line line{finds_slope ? xy / xx : 1, 0, 0};
    line.level = y - line.slope * x;
    for (const auto& [px, py] : points) line.residual += std::pow(py - line.level - line.slope * px, 2);
    return line;
}

LawFit fit_of(const FoamLaw& law, std::span<const StiffnessTest> tests) {
    std::vector<std::pair<double, double>> points;
    Interval ratios{infinity, -infinity};
    for (const StiffnessTest& test : tests) {
        if (!law.ratios().contains(test.ratio)) {
            throw InputError("a test with members of " + format_number(test.ratio, 4) +
                             " of a cell; accepted: " + format_number(law.ratios().lo, 4) + " to " +
                             format_number(law.ratios().hi, 4));
        }
        if (!(test.young > 0 && test.young < 1e9))
            throw InputError("a test's modulus is not positive; accepted: MPa");
        points.emplace_back(logarithm(law.at(test.ratio).young), logarithm(test.young));
        ratios = {std::min(ratios.lo, test.ratio), std::max(ratios.hi, test.ratio)};
    }
    constexpr double apart = 1.2;
    const bool finds_slope = points.size() > 2 && ratios.hi > apart * ratios.lo;
    const Line line = line_through(points, finds_slope);
    if (!(line.slope > 0.1))
        throw InputError(
            "the tests do not stiffen as members get thicker; accepted: a cell, a member (mm) "
            "and a modulus (MPa) a line");
    LawFit fit{exponential(line.level), line.slope, 0, points.size()};
    const std::size_t found = finds_slope ? 2 : 1;
    if (points.size() > found) {
        const std::size_t degrees = points.size() - found;
        const double scatter = std::sqrt(line.residual / static_cast<double>(degrees) *
                                         (1 + 1 / static_cast<double>(points.size())));
        fit.band = exponential(student_t(degrees) * scatter) - 1;
    }
    return fit;
}

}  // namespace

FoamModulus::FoamModulus(FoamLaw law, double young) : law_(std::move(law)), fit_{young, 1, 0, 0} {
    check_material({young, law_poisson});
}

FoamModulus::FoamModulus(FoamLaw law, double young, std::span<const StiffnessTest> tests)
    : FoamModulus(std::move(law), young) {
    if (!tests.empty()) fit_ = fit_of(law_, tests);
}

Interval FoamModulus::moduli() const { return {modulus_of(law_.ratios().lo), modulus_of(law_.ratios().hi)}; }

double FoamModulus::ratio_of(double modulus) const {
    if (!(modulus > 0)) return std::isnan(modulus) ? modulus : law_.ratios().lo;
    const double share = modulus / fit_.scale;
    return law_.ratio_of(fit_.exponent == 1 ? share : power(share, 1 / fit_.exponent));
}

double FoamModulus::modulus_of(double ratio) const {
    const double share = law_.at(ratio).young;
    return fit_.scale * (fit_.exponent == 1 ? share : power(share, fit_.exponent));
}

double FoamModulus::band() const {
    constexpr double of_elements = 0.02;  // discretisation error with two to four elements along a radius
    return fit_.band > 0 ? fit_.band : std::hypot(2 * law_.spread(), of_elements);
}

}  // namespace lamella
