// Values scaled by the maximum gradient; ranges from the ranges of the angles.
#include "procedural/lattice/tpms_solid.h"

#include <algorithm>

namespace lamella {
namespace {

constexpr int survey_side = 16;
constexpr double survey_safety = 1.5;

/// Gradings are clamped to their ranges, so the range of a constant is a single number.
bool is_constant_over(const Grading& grading, const Box& box) {
    const Interval range = grading.range(box);
    return range.lo == range.hi;
}

Interval product(Interval a, Interval positive) {
    return {std::min(a.lo * positive.lo, a.lo * positive.hi),
            std::max(a.hi * positive.lo, a.hi * positive.hi)};
}

}  // namespace

TpmsSolid::TpmsSolid(const TpmsSettings& settings)
    : settings_(settings),
      g_(tpms_constants(settings.kind)),
      center_(settings.region.center()),
      period_(settings.period->at(center_)),
      thickness_(settings.thickness->at(center_)),
      constant_period_(is_constant_over(*settings.period, settings.region)),
      constant_thickness_(is_constant_over(*settings.thickness, settings.region)) {
    if (!is_constant()) graded_change_ = survey_gradings();
}

dvec3 TpmsSolid::survey_gradings() const {
    // Each point of the lattice together with its neighbours along x, y and z.
    constexpr std::size_t group = 4;
    const dvec3 step = settings_.region.size() / static_cast<double>(survey_side);
    std::vector<dvec3> points;
    for (int i = 0; i < survey_side * survey_side * survey_side; ++i) {
        const dvec3 at(i % survey_side, i / survey_side % survey_side, i / survey_side / survey_side);
        const dvec3 p = settings_.region.lo + at * step;
        points.insert(points.end(), group, p);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<glm::length_t>(axis);
            points[points.size() - 3 + axis][k] += step[k];
        }
    }
    std::vector<double> period(points.size()), thickness(points.size());
    periods(points, period);
    thicknesses(points, thickness);
    dvec3 most(0);
    for (std::size_t i = 0; i < points.size(); i += group) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<glm::length_t>(axis);
            const std::size_t j = i + 1 + axis;
            if (!(step[k] > 0)) continue;
            const double of_period = std::abs(period[j] - period[i]) / step[k];
            const double of_thickness = std::abs(thickness[j] - thickness[i]) / step[k];
            const double farther = std::max(length(points[i] - center_), length(points[j] - center_));
            const double stretch = of_period * farther / std::min(period[i], period[j]);
            const double scale = of_period * 2 * g_.greatest / (turn * g_.steepest);
            most[k] = std::max(most[k], stretch + scale + of_thickness / 2);
        }
    }
    return most * survey_safety;
}

double TpmsSolid::value_of(double g, double period, double thickness) const {
    const double scale = period / (turn * g_.steepest);
    if (settings_.network) return (g - g_.joined) * scale - thickness / 2;
    return std::abs(g) * scale - g_.steepest_surface / g_.steepest * (thickness / 2);
}

Interval TpmsSolid::solid_levels(double period, double thickness) const {
    const double steps = turn * (thickness / 2) / period;
    if (settings_.network) return {-infinity, g_.joined + g_.steepest * steps};
    return {-g_.steepest_surface * steps, g_.steepest_surface * steps};
}

double TpmsSolid::value(dvec3 p) const {
    const double period = period_at(p);
    const dvec3 d = p - center_;
    const Wave wave = tpms_wave(kind(), Axis::x, angle(d.y, period), angle(d.z, period));
    return value_of(wave.at(angle(d.x, period)), period, thickness_at(p));
}

void TpmsSolid::values(std::span<const dvec3> points, std::span<double> out) const {
    std::vector<double> period(points.size()), angles(3 * points.size());
    std::vector<SineCosine> turns(angles.size());
    periods(points, period);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const dvec3 d = points[i] - center_;
        angles[3 * i] = angle_of(d.x, period[i]);
        angles[3 * i + 1] = angle_of(d.y, period[i]);
        angles[3 * i + 2] = angle_of(d.z, period[i]);
    }
    sines_cosines(angles, turns);
    thicknesses(points, out);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Wave wave = tpms_wave(kind(), Axis::x, turns[3 * i + 1], turns[3 * i + 2]);
        out[i] = value_of(wave.at(turns[3 * i]), period[i], out[i]);
    }
}

void TpmsSolid::periods(std::span<const dvec3> points, std::span<double> out) const {
    if (!constant_period_) return settings_.period->numbers(points, out);
    std::fill(out.begin(), out.end(), period_);
}

void TpmsSolid::thicknesses(std::span<const dvec3> points, std::span<double> out) const {
    if (!constant_thickness_) return settings_.thickness->numbers(points, out);
    std::fill(out.begin(), out.end(), thickness_);
}

Interval TpmsSolid::range(const Box& box) const {
    const Interval period = constant_period_ ? Interval{period_, period_} : settings_.period->range(box);
    const Interval thickness = thickness_over(box);
    Box angles{(box.lo - center_) * turn, (box.hi - center_) * turn};
    angles = {glm::min(angles.lo / period.lo, angles.lo / period.hi),
              glm::max(angles.hi / period.lo, angles.hi / period.hi)};
    Interval g = tpms_range(kind(), angles);
    const double scale = 1 / (turn * g_.steepest);
    if (settings_.network) {
        const Interval part = product({(g.lo - g_.joined) * scale, (g.hi - g_.joined) * scale}, period);
        return {part.lo - thickness.hi / 2, part.hi - thickness.lo / 2};
    }
    g = {g.contains(0) ? 0 : std::min(std::abs(g.lo), std::abs(g.hi)),
         std::max(std::abs(g.lo), std::abs(g.hi))};
    const double share = g_.steepest_surface / g_.steepest / 2;
    return {g.lo * scale * period.lo - share * thickness.hi, g.hi * scale * period.hi - share * thickness.lo};
}

}  // namespace lamella
