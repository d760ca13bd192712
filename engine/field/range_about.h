// What the value at one point tells of the values around it.
#pragma once

#include <cmath>
#include <limits>

#include "engine/field/field.h"

namespace lamella {

/// Encloses every value over a box at whose centre a field of the metric has the value.
inline Interval range_about(const Box& box, double value, Metric metric) {
    if (metric == Metric::sign || box.empty()) return {-infinity, infinity};
    const dvec3 half = box.size() * 0.5;
    const double reach = std::sqrt(half.x * half.x + half.y * half.y + half.z * half.z);
    if (!(std::abs(value) > reach) || !std::isfinite(reach)) return {-infinity, infinity};
    // The value is a bound of the distance, so the sign holds within |value|; the far side is not bounded.
    if (metric == Metric::exact) return {value - reach, value + reach};
    return value > 0 ? Interval{std::numeric_limits<double>::denorm_min(), infinity}
                     : Interval{-infinity, -std::numeric_limits<double>::denorm_min()};
}

}  // namespace lamella
