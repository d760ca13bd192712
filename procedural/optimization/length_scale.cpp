// Thickness of filtered strips: the mass of the cone across a strip, and inverses of it by bisection.
#include "procedural/optimization/length_scale.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/deterministic_math.h"
#include "engine/base/error.h"

namespace lamella {
namespace {

constexpr double cone_pi = 3.14159265358979323846;

/// The mass of the cone of radius 1 between the planes 0 and t: G of the header.
double cone_mass(double t, int dimensions) {
    const double a = std::min(std::fabs(t), 1.0);
    double mass = 0;
    if (dimensions == 1) {
        mass = a - 0.5 * a * a;
    } else if (dimensions == 3) {
        mass = a - a * a * a + 0.5 * a * a * a * a;
    } else if (a > 0) {
        const double c = std::sqrt((1 - a) * (1 + a));
        mass = (2 * a * c + arcsine(a) - a * a * a * logarithm((1 + c) / a)) / cone_pi;
    }
    return t < 0 ? -mass : mass;
}

/// Returns where a function that does not fall on [low, high] crosses 0, or the end nearest to that.
template <class Function>
double rising_root(double low, double high, const Function& f) {
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (low + high);
        (f(middle) < 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

void check_thresholds(double a, double b, int dimensions) {
    if (!(a > 0 && a < 1 && b > 0 && b < 1))
        throw InputError("thresholds of " + std::to_string(a) + " and " + std::to_string(b) +
                         " for a length scale: they must lie between 0 and 1");
    if (dimensions < 1 || dimensions > 3)
        throw InputError("a length scale in " + std::to_string(dimensions) + " dimensions: 1, 2 or 3");
}

/// Returns the threshold above 1/2 whose least thickness is `thickness` radii.
double threshold_for(double thickness, double farthest, int dimensions) {
    if (!(thickness > 0)) return 0.5;
    return rising_root(0.5, farthest,
                       [&](double e) { return least_thickness(e, 0.5, dimensions) - thickness; });
}

}  // namespace

double least_thickness(double survives, double design, int dimensions) {
    check_thresholds(survives, design, dimensions);
    if (survives <= design) return 0;
    const double half_strip =
        rising_root(0.0, 1.0, [&](double s) { return 2 * cone_mass(s, dimensions) - survives; });
    return 2 * rising_root(0.0, 2.0, [&](double z) {
               return design - cone_mass(half_strip + z, dimensions) - cone_mass(half_strip - z, dimensions);
           });
}

double contour_distance(double inner, double outer, int dimensions) {
    check_thresholds(inner, outer, dimensions);
    // Solid on t <= 0 gives v(t) = 1/2 - G(t).
    const auto contour = [&](double threshold) {
        return rising_root(-1.0, 1.0, [&](double t) { return threshold - 0.5 + cone_mass(t, dimensions); });
    };
    return contour(outer) - contour(inner);
}

LengthScale length_scale_for(const LengthScaleWish& wish) {
    const auto sound = [](double size) { return size >= 0 && std::isfinite(size); };
    if (!sound(wish.member) || !sound(wish.gap))
        throw InputError("least sizes of " + std::to_string(wish.member) + " mm (member) and " +
                         std::to_string(wish.gap) + " mm (gap): they must be 0 or more");
    if (!(wish.element > 0 && std::isfinite(wish.element)))
        throw InputError("elements of " + std::to_string(wish.element) + " mm: the edge must be positive");
    if (!(wish.farthest > 0.5 && wish.farthest < 1))
        throw InputError("a farthest threshold of " + std::to_string(wish.farthest) +
                         ": it must lie between 0.5 and 1");
    if (!(wish.least_radius >= 1 && std::isfinite(wish.least_radius)))
        throw InputError("a least filter radius of " + std::to_string(wish.least_radius) +
                         " elements: it must be at least 1");
    const double member = wish.member / wish.element, gap = wish.gap / wish.element;
    const double reach = least_thickness(wish.farthest, 0.5, wish.dimensions);
    LengthScale scale;
    scale.radius = std::max(wish.least_radius, std::max(member, gap) / reach);
    scale.eroded = threshold_for(member / scale.radius, wish.farthest, wish.dimensions);
    scale.dilated = 1 - threshold_for(gap / scale.radius, wish.farthest, wish.dimensions);
    return scale;
}

}  // namespace lamella
