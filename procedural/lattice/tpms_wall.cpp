// Distances by Newton's method where bounds leave them open, and runs by halving a period.
#include "procedural/lattice/tpms_wall.h"

#include <algorithm>

namespace lamella {
namespace {

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

TpmsWall::TpmsWall(TpmsKind kind) : kind_(kind), g_(tpms_constants(kind)), sole_(sole_distance(kind)) {}

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

std::optional<TpmsWall::Nearest> TpmsWall::signed_distance(const TpmsPoint& point,
                                                           std::optional<dvec3> start) const {
    const TpmsSample sample = tpms_sample(kind_, point);
    if (shortest(std::abs(sample.g), glm::length(sample.gradient), g_.sharpest) > sole_) return std::nullopt;
    dvec3 foot = start.value_or(gradient_step(sample));
    const double length = search(point, foot, 0, true);
    if (!(length <= sole_)) return std::nullopt;
    const TpmsPoint at = tpms_point_beside(point, foot);
    const dvec3 gradient = tpms_sample(kind_, at).gradient;
    const double slope = glm::length(gradient), distance = sample.g < 0 ? -length : length;
    // The surface's curvatures, carried along its normal: 1 / (radius + distance).
    const dvec3 normal = gradient / slope;
    const glm::dmat3 tangential = glm::dmat3(1) - glm::outerProduct(normal, normal);
    const glm::dmat3 curvature = tangential * tpms_hessian(kind_, at) * tangential / slope;
    return Nearest{distance, normal, curvature * glm::inverse(glm::dmat3(1) + distance * curvature), foot};
}

double TpmsWall::least_distance(const TpmsPoint& point) const {
    const TpmsSample sample = tpms_sample(kind_, point);
    return std::max(shortest(std::abs(sample.g), glm::length(sample.gradient), g_.sharpest), sole_);
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

}  // namespace lamella
