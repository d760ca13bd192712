// Bounds on a field's values around a point, from the value there and the metric.
#pragma once

#include <cmath>
#include <limits>

#include "engine/field/field.h"

namespace lamella {

/// Returns an interval that encloses every value over a box, given the field's value at its centre and its
/// metric.
inline Interval range_about(const Box& box, double value, Metric metric) {
    if (metric == Metric::sign || box.empty()) return {-infinity, infinity};
    const dvec3 half = box.size() * 0.5;
    const double reach = std::sqrt(half.x * half.x + half.y * half.y + half.z * half.z);
    if (!(std::abs(value) > reach) || !std::isfinite(reach)) return {-infinity, infinity};
    // A bound guarantees the sign within |value| of the point, but does not limit the magnitude.
    if (metric == Metric::exact) return {value - reach, value + reach};
    return value > 0 ? Interval{std::numeric_limits<double>::denorm_min(), infinity}
                     : Interval{-infinity, -std::numeric_limits<double>::denorm_min()};
}

}  // namespace lamella
