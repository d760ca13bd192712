// The loop of analysis, sensitivities and update.
#include "procedural/optimization/topology_optimizer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.h"
#include "procedural/optimization/greyness.h"
#include "procedural/optimization/oc_update.h"
#include "procedural/optimization/variable_blocks.h"

namespace lamella {

namespace {

/// Returns the number of times the sharpness doubles, from 1 until it is reached, and once more for coming
/// on.
int phases_of(const TopologySettings& settings) {
    if (!(settings.sharpness > 0)) return 0;
    int phases = 1;
    for (double sharpness = 1; sharpness < settings.sharpness; sharpness *= 2) ++phases;
    return phases;
}

template <std::size_t Dim>
DensitySettings with_limits(DensitySettings density, const TopologyProblem<Dim>& problem) {
    density.limits = problem.limits;
    return density;
}

double mean_of(std::span<const double> density, double elements) {
    return sum_over_variables<double>(density.size(),
                                      [&](std::size_t i, double& sum) { sum += density[i]; }) /
           elements;
}

}  // namespace

template <std::size_t Dim>
TopologyOptimizer<Dim>::TopologyOptimizer(const TopologyProblem<Dim>& problem,
                                          const TopologySettings& settings)
    : problem_(problem),
      settings_(settings),
      map_(problem.body.grid.elements(), problem.use, with_limits(settings.density, problem)),
      compliance_(problem, {.tolerance = settings.solver_tolerance, .cancel = settings.cancel},
                  settings.shared),
      mma_(problem.use.size(), 1, {.move = settings.move}),
      bounds_(design_bounds(problem)),
      phases_(phases_of(settings)) {
    double free = 0, prescribed = 0, least = 0;
    for (std::size_t i = 0; i < problem.use.size(); ++i) {
        const ElementUse use = problem.use[i];
        if (use == ElementUse::free) {
            free += 1;
            least += problem.limits_at(i).lo;
        }
        if (use == ElementUse::solid) prescribed += 1;
        if (use == ElementUse::kept) prescribed += problem.limits_at(i).lo;
        elements_ += use != ElementUse::outside ? 1 : 0;
    }
    if (free == 0) throw InputError("a topology problem has no free element");
    const DensitySettings& density = settings.density;
    const bool mirrored = std::ranges::any_of(density.mirrored, [](bool m) { return m; });
    if (settings.sensitivity_filter && (density.length_scale || density.overhang || mirrored ||
                                        settings.sharpness > 0 || !problem.limits.empty()))
        throw InputError(
            "the sensitivity filter knows no length scale, overhang, symmetry, projection or limits by "
            "element");
    // Not summed where all limits are alike: results keep their bits.
    least_volume_ =
        (prescribed + (problem.limits.empty() ? free * problem.least_density : least)) / elements_;
    if (settings.compliance > 0) state_.volume = 0.5 * (least_volume_ + problem.volume);
    state_.design = start_design(prescribed, free);
    // Thresholds of a length scale mean nothing without a projection.
    if (map_.has_three_fields() && phases_ > 0) state_.phase = 1;
}

/// Returns the design of even density; where limits differ, of densities at the same share of their ranges.
template <std::size_t Dim>
std::vector<double> TopologyOptimizer<Dim>::start_design(double prescribed, double free) const {
    const double even = (volume() * elements_ - prescribed) / free;
    if (!(problem_.limits.empty() ? even > problem_.least_density : volume() > least_volume_))
        throw InputError("what is kept solid, or at its density, fills " +
                         std::to_string(100 * prescribed / elements_) + " % of the body; the volume may be " +
                         std::to_string(100 * problem_.volume) + " %");
    double range = 0;
    for (std::size_t i = 0; i < bounds_.lower.size(); ++i) range += bounds_.upper[i] - bounds_.lower[i];
    const double share = range > 0 ? (volume() - least_volume_) * elements_ / range : 0;
    std::vector<double> design;
    for (std::size_t i = 0; i < bounds_.lower.size(); ++i) {
        const double lower = bounds_.lower[i], upper = bounds_.upper[i];
        const double start = problem_.limits.empty() ? even : lower + share * (upper - lower);
        design.push_back(std::clamp(start, lower, upper));
    }
    return design;
}

template <std::size_t Dim>
void TopologyOptimizer<Dim>::set_state(TopologyState state) {
    if (state.design.size() != problem_.use.size() || state.phase < 0 || state.phase > phases_)
        throw InputError("the state of a topology optimisation does not fit the problem");
    compliance_.set_displacements(state.displacements);
    mma_.set_state(state.mma);
    state_ = std::move(state);
}

template <std::size_t Dim>
double TopologyOptimizer<Dim>::sharpness() const {
    return state_.phase == 0 ? 0 : std::min(std::ldexp(1.0, state_.phase - 1), settings_.sharpness);
}

/// A sharp projection turns a small change of the design into a large one of the densities.
template <std::size_t Dim>
double TopologyOptimizer<Dim>::move() const {
    return settings_.move / std::sqrt(std::max(1.0, sharpness()));
}

template <std::size_t Dim>
typename Compliance<Dim>::Result TopologyOptimizer<Dim>::analyse() {
    show_design();
    return compliance_.evaluate(density(DensityMap::Role::result));
}

template <std::size_t Dim>
std::span<const double> TopologyOptimizer<Dim>::density(DensityMap::Role role) const {
    if (settings_.sensitivity_filter) return state_.design;
    return map_.density(role);
}

/// Optimality criteria know the volume to first order. Where densities are not linear in the design, looks
/// for the excess with which a step meets the volume (secant method).
template <std::size_t Dim>
std::vector<double> TopologyOptimizer<Dim>::oc_step(const std::vector<double>& compliance_gradient,
                                                    const std::vector<double>& volume_gradient,
                                                    double excess) {
    const auto step = [&](double with_excess) {
        return oc_update({.x = state_.design,
                          .lower = bounds_.lower,
                          .upper = bounds_.upper,
                          .compliance_gradient = compliance_gradient,
                          .volume_gradient = volume_gradient,
                          .excess = with_excess},
                         {.move = move(), .tolerance = settings_.oc_tolerance});
    };
    std::vector<double> next = step(excess);
    if (sharpness() == 0 && !settings_.density.overhang) return next;
    constexpr int most_steps = 6;
    constexpr double enough = 1e-3;  // of the volume
    const auto error_of = [&](const std::vector<double>& design) {
        map_.forward(design, sharpness());
        return mean_of(density(DensityMap::Role::result), elements_) - volume();
    };
    double error = error_of(next), least = std::abs(error), former_excess = excess, former_error = error;
    for (int k = 1; k < most_steps && least > enough * volume(); ++k) {
        const double slope = k == 1 ? -1 / elements_ : (error - former_error) / (excess - former_excess);
        if (!(slope < 0)) break;  // every variable is at a bound
        former_excess = std::exchange(excess, excess - error / slope);
        std::vector<double> other = step(excess);
        former_error = std::exchange(error, error_of(other));
        if (std::abs(error) >= least) continue;
        least = std::abs(error);
        next = std::move(other);
    }
    show_design();
    return next;
}

template <std::size_t Dim>
std::vector<double> TopologyOptimizer<Dim>::next_design(const typename Compliance<Dim>::Result& found,
                                                        const std::vector<double>& compliance_gradient,
                                                        const std::vector<double>& volume_gradient,
                                                        double excess) {
    if (settings_.method == TopologyMethod::oc) {
        return oc_step(compliance_gradient, volume_gradient, excess);
    }
    // Svanberg asks for values of 1 to 100.
    constexpr double objective_scale = 10, constraint_scale = 100;
    if (state_.first_compliance == 0) state_.first_compliance = found.total;
    std::vector<double> objective(compliance_gradient), used(volume_gradient);
    const double bound = volume() * elements_;
    for (double& g : objective) g *= objective_scale / state_.first_compliance;
    for (double& g : used) g *= constraint_scale / bound;
    const double constraint = constraint_scale * excess / bound;
    return mma_
        .update({.x = state_.design,
                 .lower = bounds_.lower,
                 .upper = bounds_.upper,
                 .objective_gradient = objective,
                 .constraints = {&constraint, 1},
                 .gradients = {used}})
        .x;
}

/// The square root meets the bound at once where compliance falls with the square of the volume, and
/// approaches it where it falls less. Returns true if the volume stays: the compliance is near its bound, or
/// no volume brings it nearer.
template <std::size_t Dim>
bool TopologyOptimizer<Dim>::seek_volume(double compliance) {
    constexpr double most_change = 1.05, near_bound = 0.01;
    const double factor = std::sqrt(compliance / settings_.compliance);
    const double least = least_volume_ + 1e-3 * (problem_.volume - least_volume_);
    const double former = state_.volume;
    state_.volume =
        std::clamp(former * std::clamp(factor, 1 / most_change, most_change), least, problem_.volume);
    return state_.volume == former || std::abs(compliance / settings_.compliance - 1) < near_bound;
}

/// Counts the iteration, and goes on to the next sharpness when it is time.
template <std::size_t Dim>
void TopologyOptimizer<Dim>::advance(bool settled) {
    ++state_.iteration;
    const int left = settings_.iterations - state_.iteration,
              in_phase = state_.iteration - state_.phase_began;
    const int needed = (phases_ - state_.phase) * settings_.iterations_a_sharpness;
    const bool next =
        state_.phase == 0 ? settled || left <= needed : in_phase >= settings_.iterations_a_sharpness;
    if (state_.phase < phases_ && next) {
        ++state_.phase;
        state_.phase_began = state_.iteration;
        mma_.reset_asymptotes();
    } else if (state_.phase == phases_ && settled) {
        state_.finished = true;
    }
    if (left <= 0) state_.finished = true;
}

template <std::size_t Dim>
TopologyIteration TopologyOptimizer<Dim>::iterate() {
    using Role = DensityMap::Role;
    show_design();
    // Whatever was analysed in between or broken off leaves no trace.
    compliance_.set_displacements(state_.displacements);
    const typename Compliance<Dim>::Result found = compliance_.evaluate(density(Role::stiffness));
    const std::span<const double> filling = density(Role::volume), result = density(Role::result);

    std::vector<double> ones(problem_.use.size());
    for (std::size_t i = 0; i < ones.size(); ++i) ones[i] = problem_.use[i] == ElementUse::free ? 1.0 : 0.0;
    std::vector<double> compliance_gradient(found.gradient.size()), volume_gradient;
    if (settings_.sensitivity_filter) {
        map_.filter().sensitivities(state_.design, found.gradient, compliance_gradient);
        volume_gradient = ones;
    } else {
        compliance_gradient = map_.backward(Role::stiffness, found.gradient);
        volume_gradient = map_.backward(Role::volume, ones);
    }
    TopologyIteration report;
    report.compliance = found.total;
    report.volume = mean_of(result, elements_);
    report.sharpness = sharpness();
    report.solver_iterations = found.iterations;
    report.greyness = greyness(problem_.use, result);

    const bool volume_stays = settings_.compliance == 0 || seek_volume(found.total);
    // With three fields, the dilated one is bounded such that the result meets the volume (Wang et al. 2011).
    const double present = mean_of(filling, elements_);
    const double bound = report.volume > 0 ? volume() * present / report.volume : volume();
    const std::vector<double> next =
        next_design(found, compliance_gradient, volume_gradient, (present - bound) * elements_);
    for (std::size_t i = 0; i < next.size(); ++i)
        report.change = std::max(report.change, std::abs(next[i] - state_.design[i]));
    state_.design = next;
    state_.displacements = compliance_.all_displacements();
    advance(report.change < settings_.tolerance && volume_stays);
    state_.mma = mma_.state();
    report.index = state_.iteration;
    return report;
}

template class TopologyOptimizer<2>;
template class TopologyOptimizer<3>;

}  // namespace lamella
