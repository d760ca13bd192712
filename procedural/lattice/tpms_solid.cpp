// Values of walls and networks in mm; ranges from the ranges of the angles.
#include "procedural/lattice/tpms_solid.h"

#include <algorithm>

#include "procedural/lattice/wave_runs.h"

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
      wall_(settings.kind),
      center_(settings.region.center()),
      period_(settings.period->at(center_)),
      thickness_(settings.thickness->at(center_)),
      constant_period_(is_constant_over(*settings.period, settings.region)),
      constant_thickness_(is_constant_over(*settings.thickness, settings.region)) {
    if (settings.network) network_.emplace(settings.kind);
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
    // A network's level follows its thickness in periods, as many times as fast as the value changes.
    const double level = network_ ? std::max(network_->steepest() / g_.steepest, 1.0) : 1;
    const double farthest = network_ ? 2 * g_.greatest / g_.steepest : g_.farthest;
    dvec3 most(0);
    for (std::size_t i = 0; i < points.size(); i += group) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<glm::length_t>(axis);
            const std::size_t j = i + 1 + axis;
            if (!(step[k] > 0)) continue;
            const double of_period = std::abs(period[j] - period[i]) / step[k];
            const double of_thickness = std::abs(thickness[j] - thickness[i]) / step[k];
            const double farther = std::max(length(points[i] - center_), length(points[j] - center_));
            const double half = network_ ? thickness[i] / (2 * period[i]) : 0;
            const double stretch = of_period * farther / std::min(period[i], period[j]);
            const double scale = of_period * farthest / turn;
            most[k] = std::max(most[k], stretch + scale + level * (of_thickness / 2 + of_period * half));
        }
    }
    return most * survey_safety;
}

double TpmsSolid::value_at(const TpmsPoint& point, double period, double thickness) const {
    const double half = half_angle(thickness, period), scale = period / turn;
    if (!network_) return wall_.value(point, half) * scale;
    return (tpms_sample(kind(), point).g - network_->level(half)) * (scale / g_.steepest);
}

void TpmsSolid::find_network_runs(Axis axis, const SineCosine& across, const SineCosine& z, double thickness,
                                  std::vector<Interval>& out) const {
    const double level = network_->level(half_angle(thickness, period_));
    const WaveRuns runs = wave_runs(tpms_wave(kind(), axis, across, z), {-infinity, level});
    out.assign(runs.parts().begin(), runs.parts().end());
}

double TpmsSolid::value(dvec3 p) const {
    const double period = period_at(p);
    const dvec3 d = p - center_;
    return value_at({angle(d.x, period), angle(d.y, period), angle(d.z, period)}, period, thickness_at(p));
}

template <class Value>
void TpmsSolid::compute(std::span<const dvec3> points, std::span<double> out, const Value& value) const {
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
    for (std::size_t i = 0; i < points.size(); ++i)
        out[i] = value(TpmsPoint{turns[3 * i], turns[3 * i + 1], turns[3 * i + 2]}, period[i], out[i]);
}

void TpmsSolid::values(std::span<const dvec3> points, std::span<double> out) const {
    compute(points, out, [this](const TpmsPoint& point, double period, double thickness) {
        return value_at(point, period, thickness);
    });
}

void TpmsSolid::bounds(std::span<const dvec3> points, std::span<double> out) const {
    if (network_) return values(points, out);
    compute(points, out, [this](const TpmsPoint& point, double period, double thickness) {
        return wall_.bound(point, half_angle(thickness, period)) * (period / turn);
    });
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
    const Interval half{half_angle(thickness.lo, period.hi), half_angle(thickness.hi, period.lo)};
    const double scale = 1 / turn;
    if (!network_) {
        const Interval value = wall_.range(angles, half);
        return product({value.lo * scale, value.hi * scale}, period);
    }
    const Interval g = tpms_range(kind(), angles);
    const double to_value = scale / g_.steepest;
    return product(
        {(g.lo - network_->level(half.hi)) * to_value, (g.hi - network_->level(half.lo)) * to_value}, period);
}

}  // namespace lamella
