// Analysis, sensitivities, the step of the method of moving asymptotes, and how far it is gone.
#include "procedural/appearance/level_optimizer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/base/error.h"
#include "procedural/optimization/greyness.h"
#include "procedural/optimization/variable_blocks.h"

namespace lamella {
namespace {

constexpr double function_scale = 10;                              // Svanberg asks for values of 1 to 100
constexpr double middle_threshold = 0.5, eroded_threshold = 0.58;  // of the projection
// Steps that would leave compliance this much above its bound are shortened.
constexpr double compliance_slack = 0.02;
constexpr int most_halvings = 6;
// What the constraints of the result may be off by; further steps mend what is more.
constexpr double compliance_settled = 0.005, volume_settled = 0.0025;

double sum_of(std::span<const double> values) {
    return sum_over_variables<double>(values.size(), [&](std::size_t i, double& sum) { sum += values[i]; });
}

}  // namespace

DensitySettings plain_density_settings(const AppearanceSettings& settings) {
    DensitySettings density;
    density.radius = settings.radius;
    density.mirrored = settings.mirrored;
    return density;
}

DensitySettings eroded_density_settings(const AppearanceSettings& settings) {
    DensitySettings density = plain_density_settings(settings);
    density.length_scale = LengthScale{settings.radius, eroded_threshold, middle_threshold, middle_threshold};
    return density;
}

std::vector<std::uint8_t> prescribed_elements(const std::vector<ElementUse>& use) {
    std::vector<std::uint8_t> mask;
    mask.reserve(use.size());
    for (const ElementUse u : use) mask.push_back(u != ElementUse::free);
    return mask;
}

void LevelState::begin_stage() {
    mma = {};
    found.compliance_gradient.clear();
    found.appearance_gradient.clear();
}

LevelOptimizer::LevelOptimizer(const TopologyProblem<2>& problem, const GreyImage& exemplar,
                               const AppearanceSettings& settings, int level, double least_compliance)
    : settings_(settings),
      level_(level),
      least_compliance_(least_compliance),
      map_(problem.body.grid.elements(), problem.use, eroded_density_settings(settings)),
      compliance_(problem, {.tolerance = settings.solver_tolerance, .cancel = settings.cancel},
                  settings.shared),
      appearance_(exemplar, map_.size().x, map_.size().y, settings.match, level,
                  prescribed_elements(problem.use)),
      bounds_(design_bounds(problem)) {
    for (const ElementUse use : problem.use) {
        const bool is_free = use == ElementUse::free;
        free_.push_back(is_free ? 1.0 : 0.0);
        elements_ += use != ElementUse::outside ? 1 : 0;
    }
}

/// Brings what depends on former steps to where the state has it: whatever was broken off leaves no trace.
void LevelOptimizer::restore(const LevelState& state) {
    const std::size_t slopes = state.found.compliance_gradient.size();
    if (state.design.size() != free_.size() || (slopes != 0 && slopes != free_.size()) ||
        state.found.appearance_gradient.size() != slopes || state.steps < 0)
        throw InputError("the state of a search for an appearance does not fit its grid");
    check_mma_state(state.mma, free_.size());
    compliance_.set_displacements(state.displacements);
    appearance_.set_matches(state.matches);
}

Compliance<2>::Result LevelOptimizer::analyse_structure(const std::vector<double>& design, double sharpness) {
    stop_if_cancelled(settings_.cancel);
    map_.forward(design, sharpness);
    return compliance_.evaluate(map_.density(DensityMap::Role::stiffness));
}

LevelAnalysis LevelOptimizer::analyse(Compliance<2>::Result structure) {
    stop_if_cancelled(settings_.cancel);
    LevelAnalysis found;
    found.compliance = structure.total;
    found.compliance_gradient = std::move(structure.gradient);
    found.solver_iterations = structure.iterations;
    appearance_.match(density());
    found.appearance_gradient.resize(free_.size());
    found.appearance = appearance_.energy(density(), found.appearance_gradient);
    found.volume = sum_of(density()) / elements_;
    found.greyness = greyness(map_.use(), density());
    return found;
}

std::vector<double> LevelOptimizer::wished_design(Mma& mma, const std::vector<double>& design,
                                                  const LevelAnalysis& found, double first_appearance) const {
    using Role = DensityMap::Role;
    const auto gradient = [&](Role role, std::span<const double> by_density, double scale) {
        std::vector<double> by_design = map_.backward(role, by_density);
        for (double& g : by_design) g *= scale;
        return by_design;
    };
    const double most = most_compliance(), n = elements_;
    const auto objective =
        gradient(Role::result, found.appearance_gradient, function_scale / first_appearance);
    std::vector<double> constraints{function_scale * (found.compliance / most - 1),
                                    function_scale * (found.volume / settings_.volume - 1)};
    std::vector<std::vector<double>> gradients{
        gradient(Role::stiffness, found.compliance_gradient, function_scale / most),
        gradient(Role::result, free_, function_scale / (settings_.volume * n))};
    if (settings_.volume_min > 0) {
        constraints.push_back(function_scale * (1 - found.volume / settings_.volume_min));
        gradients.push_back(gradient(Role::result, free_, -function_scale / (settings_.volume_min * n)));
    }
    return mma
        .update({.x = design,
                 .lower = bounds_.lower,
                 .upper = bounds_.upper,
                 .objective_gradient = objective,
                 .constraints = constraints,
                 .gradients = {gradients.begin(), gradients.end()}})
        .x;
}

/// Goes towards a design, half as far as long as the structure would break: where a thin line of solid parts,
/// compliance leaps, and no approximation foresees it.
LevelOptimizer::Candidate LevelOptimizer::step_towards(const std::vector<double>& wish,
                                                       const std::vector<double>& design, double present,
                                                       double sharpness) {
    const double bound = std::max(present, (1 + compliance_slack) * most_compliance());
    std::vector<double> next = wish;
    for (int halvings = 0;; ++halvings) {
        std::optional<Compliance<2>::Result> structure;
        try {
            structure = analyse_structure(next, sharpness);
        } catch (const FaultError&) {  // so soft that the solver gives up
            if (halvings == most_halvings) throw;
        }
        if (structure && (structure->total <= bound || halvings == most_halvings))
            return {std::move(next), analyse(std::move(*structure))};
        for (std::size_t i = 0; i < next.size(); ++i) next[i] = 0.5 * (next[i] + design[i]);
    }
}

Mma LevelOptimizer::make_mma(double move) const {
    return {free_.size(), settings_.volume_min > 0 ? std::size_t{3} : std::size_t{2}, {.move = move}};
}

AppearanceStep LevelOptimizer::step(LevelState& state, const LevelStage& stage) {
    restore(state);
    Mma mma = make_mma(stage.move);
    mma.set_state(state.mma);
    LevelAnalysis found = state.found;
    if (found.compliance_gradient.empty()) {
        found = analyse(analyse_structure(state.design, stage.sharpness));
    } else {
        map_.forward(state.design, stage.sharpness);
    }
    const double first = state.first_appearance == 0 ? found.appearance : state.first_appearance;
    AppearanceStep step;
    step.level = level_;
    step.index = state.steps + 1;
    step.appearance = found.appearance;
    step.compliance = found.compliance / least_compliance_;
    step.volume = found.volume;
    step.greyness = found.greyness;
    step.sharpness = stage.sharpness;
    step.solver_iterations = found.solver_iterations;
    Candidate next = step_towards(wished_design(mma, state.design, found, first), state.design,
                                  found.compliance, stage.sharpness);
    for (std::size_t i = 0; i < free_.size(); ++i)
        step.change = std::max(step.change, std::abs(next.design[i] - state.design[i]));
    state = {.design = std::move(next.design),
             .found = std::move(next.found),
             .mma = mma.state(),
             .matches = appearance_.matches().state(),
             .displacements = compliance_.all_displacements(),
             .steps = step.index,
             .first_appearance = first};
    return step;
}

bool LevelOptimizer::is_feasible(const LevelAnalysis& found) const {
    return found.compliance <= (1 + compliance_settled) * most_compliance() &&
           found.volume <= (1 + volume_settled) * settings_.volume &&
           found.volume >= (1 - volume_settled) * settings_.volume_min;
}

}  // namespace lamella
