// Levels by maximising g over balls along the struts' axes; between the tabulated ones by cubic Hermite
// pieces.
#include "procedural/lattice/tpms_network.h"

#include <algorithm>
#include <array>

namespace lamella {
namespace {

constexpr double table_step = pi / 32;  // radians
constexpr int axis_points = 17;
constexpr std::size_t ascents = 4;
constexpr int ascent_steps = 60;

/// The part of a strut's axis on which the greatest ball is met: from a saddle to a minimum beside it.
struct HalfAxis {
    dvec3 begin, direction;  // of any length
    double length;           // radians
};

HalfAxis half_axis(TpmsKind kind) {
    switch (kind) {
        case TpmsKind::gyroid:
            return {{0, 1.5 * pi, 1.75 * pi}, dvec3(1, -1, 0), pi * std::sqrt(2.0) / 4};
        case TpmsKind::schwarz_p:
            return {{0, pi, pi}, {1, 0, 0}, pi};
        case TpmsKind::schwarz_d:
            return {{pi / 2, pi / 2, 1.5 * pi}, dvec3(1, 1, 1), pi * std::sqrt(3.0) / 4};
        case TpmsKind::neovius:
            break;
    }
    // From the saddle, where 3 - 4 cos y = 0, to the weak minimum (pi, 0, 0).
    const double saddle = arccosine(0.75);
    return {{pi, saddle, -saddle}, dvec3(0, -1, 1), saddle * std::sqrt(2.0)};
}

struct Maximum {
    double g = -infinity;
    double slope = 0;  ///< of g outward
};

/// The directions to corners, edges and faces of a cube, turned a little off all symmetries.
dvec3 direction(int side) {
    const int k = side < 13 ? side : side + 1;  // not the middle
    return glm::normalize(dvec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1) + dvec3(0.01, 0.02, 0.03));
}

/// Returns the maximum of g over the ball. Ascends on its sphere from the sides where g is greatest; the
/// shift by the maximum second derivative makes each step rise.
Maximum maximum_in_ball(TpmsKind kind, const TpmsPoint& center, double radius) {
    const double shift = tpms_constants(kind).sharpest * radius;
    const auto sample = [&](dvec3 way) { return tpms_sample(kind, tpms_point_beside(center, way * radius)); };
    std::array<std::pair<double, int>, 26> sides;
    for (int side = 0; side < 26; ++side)
        sides[static_cast<std::size_t>(side)] = {-sample(direction(side)).g, side};
    std::partial_sort(sides.begin(), sides.begin() + ascents, sides.end());
    Maximum best;
    for (std::size_t i = 0; i < ascents; ++i) {
        dvec3 way = direction(sides[i].second);
        TpmsSample at = sample(way);
        for (int step = 0; step < ascent_steps; ++step) {
            way = glm::normalize(at.gradient + way * shift);
            at = sample(way);
        }
        if (at.g > best.g) best = {at.g, glm::dot(at.gradient, way)};
    }
    return best;
}

}  // namespace

TpmsNetwork::Entry TpmsNetwork::entry(double half) const {
    const HalfAxis axis = half_axis(kind_);
    Maximum best;
    for (int i = 0; i < axis_points; ++i) {
        const dvec3 along = glm::normalize(axis.direction) * (axis.length * i / (axis_points - 1));
        const Maximum here = maximum_in_ball(kind_, tpms_point(axis.begin + along), half);
        if (here.g > best.g) best = here;
    }
    return {best.g, best.slope};
}

TpmsNetwork::TpmsNetwork(TpmsKind kind) : kind_(kind), step_(table_step) {
    const double end = -tpms_constants(kind).joined;
    entries_.push_back({tpms_constants(kind).joined, 0});
    steepest_ = 0;
    while (entries_.back().level < end) {
        entries_.push_back(entry(static_cast<double>(entries_.size()) * step_));
        steepest_ = std::max(steepest_, entries_.back().slope);
    }
    Interval halves{0, static_cast<double>(entries_.size() - 1) * step_};
    for (int i = 0; i < 50; ++i) {
        const double middle = (halves.lo + halves.hi) / 2;
        (level(middle) < end ? halves.lo : halves.hi) = middle;
    }
    greatest_half_ = halves.lo;
}

double TpmsNetwork::level(double half) const {
    const double place = std::clamp(half / step_, 0.0, static_cast<double>(entries_.size() - 1));
    const std::size_t i = std::min(static_cast<std::size_t>(place), entries_.size() - 2);
    const double t = place - static_cast<double>(i), u = 1 - t;
    const Entry &a = entries_[i], &b = entries_[i + 1];
    return u * u * (1 + 2 * t) * a.level + t * t * (1 + 2 * u) * b.level +
           t * u * step_ * (u * a.slope - t * b.slope);
}

}  // namespace lamella
