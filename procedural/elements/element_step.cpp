// Variables are changes over what a step may change: from -1 to 1, now 0.
#include "procedural/elements/element_step.h"

#include <algorithm>

#include "procedural/optimization/mma.h"

namespace lamella {

ElementStep::ElementStep(const CellGrid& grid, std::vector<double> arms, bool turns, bool scales)
    : grid_(grid), arms_(std::move(arms)) {
    const int axes = grid.is_flat ? 2 : 3;
    variables_.push_back({Kind::middle, 0});
    for (int axis = 1; axis < axes; ++axis) {
        if (turns) {
            variables_.push_back({Kind::near_end, axis});
            variables_.push_back({Kind::far_end, axis});
        } else {
            variables_.push_back({Kind::middle, axis});
        }
    }
    if (turns && !grid.is_flat) variables_.push_back({Kind::roll, 0});
    if (scales) variables_.push_back({Kind::scale, 0});
}

/// Returns the change that 1 stands for.
double ElementStep::unit(const Variable& variable, const StepLimits& limits) const {
    if (variable.kind == Kind::roll) return limits.turn;
    return variable.kind == Kind::scale ? limits.scale : limits.place;
}

/// An end that moves by d moves the middle by d / 2, and turns the element by d / (2 arm): the end at +arm
/// about x cross its axis, the one at -arm the other way.
double ElementStep::derivative(const Variable& variable, const PlacedElement& element,
                               const ElementGradient& gradient) const {
    if (variable.kind == Kind::scale) return gradient.scale;
    dvec3 axis(0);
    axis[variable.axis] = 1;
    const dvec3 way = element.turn * axis, along = element.turn * dvec3(1, 0, 0);
    if (variable.kind == Kind::middle) return dot(gradient.at, way);
    if (variable.kind == Kind::roll) return dot(gradient.turn, way);
    const double arm = arms_[element.shape] * element.scale;
    const double by_turn = dot(gradient.turn, glm::cross(along, way)) / (2 * arm);
    return 0.5 * dot(gradient.at, way) + (variable.kind == Kind::far_end ? by_turn : -by_turn);
}

std::vector<double> ElementStep::derivatives(std::span<const PlacedElement> elements,
                                             std::span<const ElementGradient> gradients,
                                             const StepLimits& limits) const {
    std::vector<double> all;
    for (std::size_t k = 0; k < elements.size(); ++k) {
        for (const Variable& variable : variables_)
            all.push_back(unit(variable, limits) * derivative(variable, elements[k], gradients[k]));
    }
    return all;
}

PlacedElement ElementStep::changed(PlacedElement element, std::span<const double> changes,
                                   const StepLimits& limits) const {
    const double arm = arms_[element.shape] * element.scale;
    const dvec3 along = element.turn * dvec3(1, 0, 0);
    dvec3 shift(0), rotation(0);
    for (std::size_t i = 0; i < variables_.size(); ++i) {
        const Variable& variable = variables_[i];
        const double change = unit(variable, limits) * changes[i];
        dvec3 axis(0);
        axis[variable.axis] = 1;
        const dvec3 way = element.turn * axis;
        if (variable.kind == Kind::scale) {
            element.scale = std::clamp(element.scale + change, limits.scales.lo, limits.scales.hi);
        } else if (variable.kind == Kind::roll) {
            rotation += change * way;
        } else if (variable.kind == Kind::middle) {
            shift += change * way;
        } else {
            const double side = variable.kind == Kind::far_end ? 1 : -1;
            shift += 0.5 * change * way;
            rotation += side * change / (2 * arm) * glm::cross(along, way);
        }
    }
    const Box box = grid_.box();
    element.at = glm::clamp(element.at + shift, box.lo, box.hi);
    return turned(element, rotation);
}

/// Reaches grow where the slope goes on down the way of the step that was taken, and shrink elsewhere.
void ElementStep::adapt(std::span<const double> slopes) {
    constexpr double widen = 1.2, narrow = 0.5, narrowest = 0.02;
    if (reaches_.size() != slopes.size()) reaches_.assign(slopes.size(), 1.0);
    if (taken_.size() != slopes.size()) return;
    for (std::size_t j = 0; j < slopes.size(); ++j) {
        const double agreement = -slopes[j] * taken_[j];
        if (agreement > 0) reaches_[j] = std::min(widen * reaches_[j], 1.0);
        if (agreement < 0) reaches_[j] = std::max(narrow * reaches_[j], narrowest);
    }
    taken_.clear();
}

std::vector<PlacedElement> ElementStep::from(std::span<const PlacedElement> elements,
                                             std::span<const ElementGradient> objective,
                                             std::span<const ElementConstraint> constraints,
                                             const StepLimits& limits) {
    const std::vector<double> slopes = derivatives(elements, objective, limits);
    adapt(slopes);
    std::vector<double> lower, values;
    for (const double reach : reaches_) lower.push_back(-reach);
    std::vector<std::vector<double>> rows;
    for (const ElementConstraint& constraint : constraints) {
        values.push_back(constraint.value);
        rows.push_back(derivatives(elements, constraint.gradients, limits));
    }
    const std::vector<double> x(slopes.size(), 0.0);
    Mma mma(x.size(), constraints.size());
    last_ = mma.update({.x = x,
                        .lower = lower,
                        .upper = reaches_,
                        .objective_gradient = slopes,
                        .constraints = values,
                        .gradients = {rows.begin(), rows.end()}})
                .x;
    std::vector<PlacedElement> next;
    for (std::size_t k = 0; k < elements.size(); ++k)
        next.push_back(
            changed(elements[k], std::span(last_).subspan(k * variables_.size(), variables_.size()), limits));
    return next;
}

}  // namespace lamella
