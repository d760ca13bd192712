// Roots of the quartic between the turning points of its slope.
#include "engine/solids/torus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/base/root_between.h"

namespace lamella {

namespace {

/// Whether a part of a line is nearer to the axis than the tube: the distance is greatest at an end.
bool in_hole(const Torus& torus, dvec3 p, dvec3 way, const Interval& part) {
    const double hole = (torus.large - torus.small) * (1 - 1e-6);
    const dvec2 a(p + part.lo * way), b(p + part.hi * way);
    return std::max(squared_length(a), squared_length(b)) < hole * hole;
}

}  // namespace

double signed_distance(const Torus& torus, dvec3 p) {
    return length(dvec2(length(dvec2(p)) - torus.large, p.z)) - torus.small;
}

Box bounds(const Torus& torus) {
    const dvec3 half(torus.large + torus.small, torus.large + torus.small, torus.small);
    return {-half, half};
}

void cut(const Torus& torus, dvec3 p, dvec3 direction, std::vector<Interval>& inside) {
    const double large = torus.large, small = torus.small;
    // A little more than the ball around it, which it touches along its equator.
    const double speed = length(direction), outside = (large + small) * (1 + 1e-6);
    const dvec3 way = direction / speed;
    const double nearest = -dot(p, way);
    const dvec3 middle = p + nearest * way;
    const double square = squared_length(middle);
    if (!(square < outside * outside)) return;
    // The part of the line in the ball, and between the planes that touch the tube.
    const double reach = std::sqrt(outside * outside - square);
    Interval part{-reach, reach};
    const double thick = small * (1 + 1e-6);
    if (way.z != 0) {
        const double a = (-thick - middle.z) / way.z, b = (thick - middle.z) / way.z;
        part = {std::max(part.lo, std::min(a, b)), std::min(part.hi, std::max(a, b))};
    } else if (std::abs(middle.z) > thick) {
        return;
    }
    if (!(part.lo < part.hi) || in_hole(torus, middle, way, part)) return;
    const double k = square + large * large - small * small, four = 4 * large * large;
    const double c2 = 2 * k - four * (1 - way.z * way.z), c1 = 2 * four * middle.z * way.z,
                 c0 = k * k - four * (square - middle.z * middle.z);
    const auto value = [&](double t) { return (t * t + c2) * t * t + c1 * t + c0; };
    const auto slope = [&](double t) { return (4 * t * t + 2 * c2) * t + c1; };
    // The slope is monotone between these, the value between the roots of the slope.
    const double bend = c2 < 0 ? std::sqrt(-c2 / 6) : 0;
    std::array<double, 5> turns{part.lo};
    std::size_t count = 1;
    double from = part.lo;
    for (double to : {-bend, bend, part.hi}) {
        to = std::min(to, part.hi);
        if (to > from && (slope(from) < 0) != (slope(to) < 0))
            turns[count++] = root_between(slope, from, slope(from), to, slope(to));
        from = std::max(from, to);
    }
    turns[count++] = part.hi;
    std::optional<double> begin;
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const double a = value(turns[i]), b = value(turns[i + 1]);
        if ((a < 0) == (b < 0)) continue;
        const double t = nearest + root_between(value, turns[i], a, turns[i + 1], b);
        if (b < 0) {
            begin = t;
        } else if (begin) {
            inside.push_back({*begin / speed, t / speed});
        }
    }
}

}  // namespace lamella
