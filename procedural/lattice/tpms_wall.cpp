// Distances by Newton's method where bounds leave them open, and runs by halving a period.
#include "procedural/lattice/tpms_wall.h"

#include <algorithm>

namespace lamella {
namespace {

constexpr int halvings = 3;             // of the parts of a period
constexpr double end_tolerance = 1e-8;  // turns
constexpr int max_newton_steps = 12;
constexpr double max_newton_step = 0.7;    // radians
constexpr double exact_within = 1.25;      // half thicknesses from the surface
constexpr std::size_t searches = 6;        // from other sides
constexpr double sure_step = 0.1;          // radians; shorter ones shrink by their squares
constexpr double newton_converged = 1e-5;  // radians; the step after it is below its square
constexpr double flat = 0.05;              // squared gradient below which a step would be too long

/// Returns a lower bound of the distance from g = 0 of a point with |g| = g and this slope.
double shortest(double g, double slope, double sharpest) {
    return 2 * g / (slope + std::sqrt(slope * slope + 2 * sharpest * g));
}

/// Returns an upper bound, infinite if there is none without a search.
double longest(double g, double slope, double sharpest) {
    const double rest = slope * slope - 2 * sharpest * g;
    return rest >= 0 && slope > 0 ? 2 * g / (slope + std::sqrt(rest)) : infinity;
}

/// Returns the step along the gradient that meets g = 0 if g is linear.
dvec3 gradient_step(const TpmsSample& sample) {
    return sample.gradient * (-sample.g / std::max(glm::dot(sample.gradient, sample.gradient), flat));
}

/// Measured, with some room: where points this near to g = 0 got another nearest point than the search found,
/// none was below 0.87 (Schwarz D), 1.02 (gyroid, Schwarz P) and 0.33 (Neovius). tpms_test.cpp compares with
/// all points.
double sole_distance(TpmsKind kind) {
    switch (kind) {
        case TpmsKind::gyroid:
        case TpmsKind::schwarz_p:
            return 0.85;
        case TpmsKind::schwarz_d:
            return 0.7;
        case TpmsKind::neovius:
            break;
    }
    return 0.25;
}

/// The directions to corners and faces of a cube.
std::array<dvec3, 14> directions() {
    std::array<dvec3, 14> all{dvec3(1, 0, 0),  dvec3(-1, 0, 0), dvec3(0, 1, 0),
                              dvec3(0, -1, 0), dvec3(0, 0, 1),  dvec3(0, 0, -1)};
    const double side = 1 / std::sqrt(3.0);
    for (unsigned k = 0; k < 8; ++k) {
        all[6 + k] =
            dvec3((k & 1U) != 0 ? side : -side, (k & 2U) != 0 ? side : -side, (k & 4U) != 0 ? side : -side);
    }
    return all;
}

}  // namespace

/// A line through the wall; `turn` runs along it.
struct TpmsWall::Line {
    Axis axis;
    SineCosine across, z;
    double half;

    TpmsPoint point(const SineCosine& turn) const { return tpms_point_on(axis, turn, across, z); }
};

TpmsWall::TpmsWall(TpmsKind kind) : kind_(kind), g_(tpms_constants(kind)), sole_(sole_distance(kind)) {
    for (std::size_t i = 0; i < first_parts; ++i)
        turns_[i] = sine_cosine(static_cast<double>(i) * (2 * pi / first_parts));
}

double TpmsWall::value(const TpmsPoint& point, double half) const {
    const TpmsSample sample = tpms_sample(kind_, point);
    const double g = std::abs(sample.g);
    if (!(shortest(g, glm::length(sample.gradient), g_.sharpest) >= half * exact_within))
        return nearest(point, sample, half, true);
    return std::max(half * exact_within, g / g_.steepest) - half;
}

double TpmsWall::bound(const TpmsPoint& point, double half) const {
    const TpmsSample sample = tpms_sample(kind_, point);
    const double g = std::abs(sample.g), slope = glm::length(sample.gradient);
    const double least = shortest(g, slope, g_.sharpest);
    if (least >= half) return least - half;
    const double most = longest(g, slope, g_.sharpest);
    if (most <= half) return most - half;
    return nearest(point, sample, half, false);
}

double TpmsWall::nearest(const TpmsPoint& point, const TpmsSample& sample, double half, bool exact) const {
    dvec3 first = gradient_step(sample);
    double value = search(point, first, half, exact);
    const bool is_sole = exact ? value + half <= sole_ : value < 0 || half <= sole_;
    if (!is_sole) {
        // The surface may be nearer on another side, most likely where g comes closest to the other sign.
        static const std::array<dvec3, 14> ways = directions();
        std::array<std::pair<double, std::size_t>, 14> found;
        for (std::size_t i = 0; i < ways.size(); ++i) {
            const double g = tpms_sample(kind_, tpms_point_beside(point, ways[i] * half)).g;
            found[i] = {sample.g > 0 ? g : -g, i};
        }
        std::partial_sort(found.begin(), found.begin() + searches, found.end());
        for (std::size_t i = 0; i < searches; ++i) {
            dvec3 offset = ways[found[i].second] * half;
            offset += gradient_step(tpms_sample(kind_, tpms_point_beside(point, offset)));
            value = std::min(value, search(point, offset, half, exact));
        }
    }
    value = std::min(value, longest(std::abs(sample.g), glm::length(sample.gradient), g_.sharpest) - half);
    if (exact) value = std::min(value, half * (exact_within - 1));
    return value < infinity ? std::max(value, std::abs(sample.g) / g_.steepest - half) : 0;
}

double TpmsWall::search(const TpmsPoint& point, dvec3& offset, double half, bool exact) const {
    double multiplier = 0;
    for (int i = 0; i < max_newton_steps; ++i) {
        const TpmsPoint at = tpms_point_beside(point, offset);
        const auto& [g, gradient] = tpms_sample(kind_, at);
        if (i == 0) multiplier = -glm::dot(offset, gradient) / std::max(glm::dot(gradient, gradient), flat);
        const glm::dmat3 inverse = glm::inverse(glm::dmat3(1) + multiplier * tpms_hessian(kind_, at));
        const dvec3 residual = offset + multiplier * gradient, along = inverse * gradient;
        double change = (g - glm::dot(along, residual)) / glm::dot(along, gradient);
        dvec3 step = -(inverse * (residual + change * gradient));
        const double length = glm::length(step);
        if (!(length < infinity)) return infinity;
        if (length > max_newton_step) {
            step *= max_newton_step / length;
            change *= max_newton_step / length;
        }
        offset += step;
        multiplier += change;
        const double value = glm::length(offset) - half;
        if (length < newton_converged) return value;
        // Steps shrink by their squares, so the remaining ones sum up to less than this one.
        if (!exact && length < sure_step && length < std::abs(value) / 8)
            return value < 0 ? value + length : value - length;
    }
    return infinity;
}

std::optional<TpmsWall::Nearest> TpmsWall::signed_distance(const TpmsPoint& point) const {
    const TpmsSample sample = tpms_sample(kind_, point);
    if (shortest(std::abs(sample.g), glm::length(sample.gradient), g_.sharpest) > sole_) return std::nullopt;
    dvec3 offset = gradient_step(sample);
    const double distance = search(point, offset, 0, true);
    if (!(distance <= sole_)) return std::nullopt;
    const dvec3 normal = glm::normalize(tpms_sample(kind_, tpms_point_beside(point, offset)).gradient);
    return Nearest{sample.g < 0 ? -distance : distance, normal};
}

Interval TpmsWall::range(const Box& angles, Interval half) const {
    const Interval g = tpms_range(kind_, angles);
    const double least = g.contains(0) ? 0 : std::min(std::abs(g.lo), std::abs(g.hi));
    const double most = std::max(std::abs(g.lo), std::abs(g.hi));
    const double reach = glm::length(angles.size()) / 2;
    double slope = g_.steepest, gentle = 0;
    if (reach < g_.farthest) {
        const double middle = glm::length(tpms_sample(kind_, tpms_point(angles.center())).gradient);
        slope = std::min(slope, middle + g_.sharpest * reach);
        gentle = std::max(middle - g_.sharpest * reach, 0.0);
    }
    const double lowest = std::min(shortest(least, slope, g_.sharpest), half.lo * exact_within);
    return {std::max(lowest, least / g_.steepest) - half.hi,
            std::min(longest(most, gentle, g_.sharpest), g_.farthest) - half.lo};
}

double TpmsWall::bound_on(const Line& line, const SineCosine& turn) const {
    return bound(line.point(turn), line.half);
}

void TpmsWall::find_runs(Axis axis, const SineCosine& across, const SineCosine& z, double half,
                         std::vector<Interval>& out) const {
    out.clear();
    const Line line{axis, across, z, half};
    std::array<double, first_parts + 1> values;
    for (std::size_t i = 0; i < first_parts; ++i) values[i] = bound_on(line, turns_[i]);
    values[first_parts] = values[0];
    std::vector<double> ends;
    for (std::size_t i = 0; i < first_parts; ++i) {
        const double begin = static_cast<double>(i) / first_parts;
        find_crossings(line, {begin, begin + 1.0 / first_parts}, {values[i], values[i + 1]}, halvings, ends);
    }
    const bool inside = values[0] < 0;
    if (ends.empty()) {
        if (inside) out.push_back({-infinity, infinity});
        return;
    }
    // The interval that holds turn 0 began in the period before.
    if (inside) out.push_back({ends.back() - 1, ends.front()});
    for (std::size_t i = inside ? 1 : 0; i + 1 < ends.size(); i += 2) out.push_back({ends[i], ends[i + 1]});
}

void TpmsWall::find_crossings(const Line& line, Interval turns, Interval values, int depth,
                              std::vector<double>& crossings) const {
    const bool same = (values.lo < 0) == (values.hi < 0);
    if (same && std::abs(values.lo) + std::abs(values.hi) >= turns.width() * (2 * pi)) return;
    if (depth == 0) {
        if (!same) crossings.push_back(crossing(line, turns, values));
        return;
    }
    const double middle = (turns.lo + turns.hi) / 2;
    const double value = bound_on(line, sine_cosine(middle * (2 * pi)));
    find_crossings(line, {turns.lo, middle}, {values.lo, value}, depth - 1, crossings);
    find_crossings(line, {middle, turns.hi}, {value, values.hi}, depth - 1, crossings);
}

/// The Illinois variant of the method of false position.
double TpmsWall::crossing(const Line& line, Interval turns, Interval values) const {
    int kept = 0;  // which end stayed at the last step: -1 the lower, 1 the upper
    while (turns.width() > end_tolerance) {
        double at = turns.lo + turns.width() * (values.lo / (values.lo - values.hi));
        if (!(turns.lo < at && at < turns.hi)) at = (turns.lo + turns.hi) / 2;
        const double value = bound_on(line, sine_cosine(at * (2 * pi)));
        if (std::abs(value) < end_tolerance) return at;
        if ((value < 0) == (values.lo < 0)) {
            turns.lo = at;
            values.lo = value;
            if (kept == 1) values.hi /= 2;
            kept = 1;
        } else {
            turns.hi = at;
            values.hi = value;
            if (kept == -1) values.lo /= 2;
            kept = -1;
        }
    }
    return (turns.lo + turns.hi) / 2;
}

}  // namespace lamella
