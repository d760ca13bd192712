// One fresh step of moving asymptotes an iteration: variables are the changes of the present elements.
#include "procedural/elements/element_optimizer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/base/error.h"
#include "procedural/voronoi/counter_hash.h"

namespace lamella {

namespace {

constexpr double width_in_cells = 1.5;          // of the smooth border of an element
constexpr int most_solver_iterations = 20'000;  // as long as elements do not reach each other
constexpr double thinner_at_first = 0.25, thinner_at_last = 0.5, late = 2.0 / 3;

/// Returns how far from its middle each shape holds on to others.
std::vector<double> arms_of(std::span<const DistanceTable> shapes) {
    constexpr double share = 0.8;
    std::vector<double> arms;
    for (const DistanceTable& shape : shapes) arms.push_back(share * shape.reach());
    return arms;
}

}  // namespace

template <std::size_t Dim>
ElementOptimizer<Dim>::ElementOptimizer(const TopologyProblem<Dim>& problem, const CellGrid& grid,
                                        std::span<const DistanceTable> shapes,
                                        const ElementSettings& settings, std::vector<PlacedElement> start)
    : problem_(problem),
      grid_(grid),
      shapes_(shapes),
      settings_(settings),
      elements_(std::move(start)),
      loads_(elements_.size(), 1.0),
      content_(0),
      step_(grid, arms_of(shapes), settings.turns, settings.scale.width() > 0),
      compliance_(problem, {.tolerance = settings.solver_tolerance,
                            .max_iterations = most_solver_iterations,
                            .cancel = settings.cancel}),
      iteration_(settings.begin) {
    if (elements_.empty()) throw InputError("no elements are placed; accepted: one or more");
    for (const PlacedElement& element : elements_) content_ += content(element);
    align(elements_);
    trial_ = elements_;
}

/// Returns the element's content in cells.
template <std::size_t Dim>
double ElementOptimizer<Dim>::content(const PlacedElement& element) const {
    const double s = element.scale;
    const double cell =
        Dim == 2 ? grid_.edges.x * grid_.edges.y : grid_.edges.x * grid_.edges.y * grid_.edges.z;
    return shapes_[element.shape].content() * (Dim == 2 ? s * s : s * s * s) / cell;
}

template <std::size_t Dim>
ElementIteration ElementOptimizer<Dim>::iterate() {
    const bool is_late = progress() >= late;
    ElementRaster raster(grid_, problem_.use, shapes_, width_in_cells * grid_.edge(),
                         is_late ? thinner_at_last : thinner_at_first);
    raster.set(trial_);
    const auto found = compliance_.evaluate(raster.densities());
    ElementIteration done{.index = iteration_ + 1, .compliance = found.total};
    if (is_late && !was_late_) is_new_ = true;  // thinner elements are not to be compared
    was_late_ = is_late;
    constexpr double slack = 1.01, widen = 1.3, narrow = 0.5, narrowest = 1e-3;
    if (is_new_ || found.total <= slack * accepted_compliance_) {
        accept(raster, found);
        reach_ = std::min(is_new_ ? 1 : widen * reach_, 1.0);
        is_new_ = false;
    } else {
        reach_ = std::max(narrow * reach_, narrowest);
    }
    ++iteration_;
    constexpr int iterations_a_move = 10;
    constexpr double first_move = 0.1, last_move = 0.75;
    if (iteration_ % iterations_a_move == 0 && progress() > first_move && progress() < last_move)
        done.moved = move_idle();
    if (done.moved > 0) {
        is_new_ = true;
        step_.forget();
        trial_ = elements_;
    } else {
        trial_ = step_.from(elements_, slopes_, constraints_, step_limits());
        align(trial_);
    }
    return done;
}

/// Takes the elements that were tried, and what tells where to go from them.
template <std::size_t Dim>
void ElementOptimizer<Dim>::accept(const ElementRaster& raster,
                                   const typename Compliance<Dim>::Result& found) {
    elements_ = trial_;
    step_.take();
    accepted_compliance_ = found.total;
    std::vector<double> by_density = found.gradient;
    for (double& slope : by_density) slope /= found.total;
    slopes_ = raster.gradients(by_density, 0);
    // As large as they are: thinner ones would overlap less than they may.
    ElementRaster whole(grid_, problem_.use, shapes_, width_in_cells * grid_.edge(), 0);
    whole.set(elements_);
    constraints_ = {overlap_bound(whole)};
    if (settings_.scale.width() > 0) constraints_.push_back(content_bound());
    measure_loads(raster, by_density);
}

template <std::size_t Dim>
StepLimits ElementOptimizer<Dim>::step_limits() const {
    constexpr double most_cells = 2, most_turn = 0.16, most_scale = 0.05, last_share = 0.15;
    const double share = reach_ * (1 - (1 - last_share) * progress());
    return {.place = share * most_cells * grid_.edge(),
            .turn = settings_.turns ? share * most_turn : 0,
            .scale = settings_.scale.width() > 0 ? share * most_scale : 0,
            .scales = settings_.scale};
}

template <std::size_t Dim>
ElementConstraint ElementOptimizer<Dim>::overlap_bound(const ElementRaster& raster) const {
    const double most = settings_.overlap * content_;
    const std::vector<double> none(raster.densities().size(), 0.0);
    return {raster.overlap() / most - 1, raster.gradients(none, 1 / most)};
}

/// Returns the bound on the content of all elements: that at the start.
template <std::size_t Dim>
ElementConstraint ElementOptimizer<Dim>::content_bound() const {
    ElementConstraint bound{-1, std::vector<ElementGradient>(elements_.size())};
    for (std::size_t k = 0; k < elements_.size(); ++k) {
        const double share = content(elements_[k]) / content_;
        bound.value += share;
        bound.gradients[k].scale = static_cast<double>(Dim) * share / elements_[k].scale;
    }
    return bound;
}

template <std::size_t Dim>
void ElementOptimizer<Dim>::measure_loads(const ElementRaster& raster,
                                          const std::vector<double>& by_density) {
    std::vector<double> energy(by_density.size());
    for (std::size_t e = 0; e < energy.size(); ++e) energy[e] = -by_density[e];
    loads_ = raster.shares(energy);
    const double all = std::accumulate(loads_.begin(), loads_.end(), 0.0);
    for (std::size_t k = 0; k < loads_.size(); ++k)
        loads_[k] *= content_ / (content(elements_[k]) * std::max(all, 1e-300));
}

/// Elements that carry next to nothing go beside those of the third that carries most, of the same turn.
template <std::size_t Dim>
std::size_t ElementOptimizer<Dim>::move_idle() {
    constexpr double idle = 0.01;
    std::vector<std::uint32_t> order(elements_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(-loads_[a], a) < std::pair(-loads_[b], b);
    });
    const std::size_t busy = std::max<std::size_t>(elements_.size() / 3, 1);
    std::size_t moved = 0;
    for (std::uint32_t k = 0; k < elements_.size(); ++k) {
        if (loads_[k] > idle) continue;
        const CounterHash draw(settings_.seed, 0, k, iteration_, 0);
        const PlacedElement& other =
            elements_[order[static_cast<std::size_t>(draw.uniform(0) * static_cast<double>(busy))]];
        const double reach = shapes_[other.shape].reach() * other.scale;
        const dvec3 aside(reach * (draw.uniform(1) - 0.5), reach * (draw.uniform(2) - 0.5),
                          Dim == 2 ? 0 : reach * (draw.uniform(3) - 0.5));
        elements_[k].at = glm::clamp(other.at + other.turn * aside, grid_.box().lo, grid_.box().hi);
        if (settings_.turns) elements_[k].turn = other.turn;
        ++moved;
    }
    align(elements_);
    return moved;
}

/// Turns the x axes of elements to the ways of their places, if there are ways.
template <std::size_t Dim>
void ElementOptimizer<Dim>::align(std::vector<PlacedElement>& elements) const {
    if (!settings_.way) return;
    for (PlacedElement& element : elements)
        element.turn = glm::normalize(
            shortest_turn(element.turn * dvec3(1, 0, 0), settings_.way(element.at)) * element.turn);
}

template class ElementOptimizer<2>;
template class ElementOptimizer<3>;

}  // namespace lamella
