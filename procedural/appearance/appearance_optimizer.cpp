// The loop over levels, and the steps of a level.
#include "procedural/appearance/appearance_optimizer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "procedural/appearance/appearance.h"
#include "procedural/appearance/design_upsampling.h"
#include "procedural/optimization/topology_optimizer.h"
#include "procedural/optimization/variable_blocks.h"

namespace lamella {
namespace {

constexpr double function_scale = 10;  // Svanberg asks for values of 1 to 100
constexpr int most_levels = 8;
constexpr double middle_threshold = 0.5, eroded_threshold = 0.58;  // of the projection
// Steps that would leave compliance this much above its bound are shortened.
constexpr double compliance_slack = 0.02;
constexpr int most_halvings = 6;
// What the constraints of the result may be off by; further steps mend what is more.
constexpr double compliance_settled = 0.005, volume_settled = 0.0025;
constexpr int most_settling_steps = 20;
constexpr double settling_move = 0.25;  // of the usual one: approximations are true near by

void require(bool is_right, const char* name, double found, const char* accepted) {
    if (!is_right)
        throw InputError(std::string("appearance: ") + name + " = " + std::to_string(found) +
                         "; accepted: " + accepted);
}

void check(const AppearanceSettings& s, int exemplar_width) {
    require(s.compliance >= 1 && std::isfinite(s.compliance), "compliance", s.compliance, "1 and more");
    require(s.volume > 0 && s.volume <= 1, "volume", s.volume, "above 0, at most 1");
    require(s.volume_min >= 0 && s.volume_min <= s.volume, "volume_min", s.volume_min, "0 to the volume");
    require(s.levels >= 1 && s.levels <= most_levels, "levels", s.levels, "1 to 8");
    require(s.steps >= 1, "steps", s.steps, "1 and more");
    require(s.steps_a_sharpness >= 1, "steps a sharpness", s.steps_a_sharpness, "1 and more");
    require(s.sharpness >= 0 && std::isfinite(s.sharpness), "sharpness", s.sharpness, "0 and more");
    require(exemplar_width >= 1, "exemplar_width", exemplar_width, "1 and more elements");
}

std::vector<std::uint8_t> prescribed(const std::vector<ElementUse>& use) {
    std::vector<std::uint8_t> mask;
    mask.reserve(use.size());
    for (const ElementUse u : use) mask.push_back(u != ElementUse::free);
    return mask;
}

DensitySettings density_settings(const AppearanceSettings& settings) {
    DensitySettings density;
    density.radius = settings.radius;
    density.mirrored = settings.mirrored;
    return density;
}

/// The loads are borne by a projection at a higher threshold: what is grey in the design is void there, so no
/// member hangs on grey that the shape, cut from the design, would not have.
DensitySettings eroded_settings(const AppearanceSettings& settings) {
    DensitySettings density = density_settings(settings);
    density.length_scale = LengthScale{settings.radius, eroded_threshold, middle_threshold, middle_threshold};
    return density;
}

double sum_of(std::span<const double> values) {
    return sum_over_variables<double>(values.size(), [&](std::size_t i, double& sum) { sum += values[i]; });
}

/// A design of one level and what its functions say.
class LevelOptimizer {
  public:
    LevelOptimizer(const TopologyProblem<2>& problem, const GreyImage& exemplar,
                   const AppearanceSettings& settings, int level, double least_compliance);

    /// Takes steps at a sharpness of the projection, with asymptotes of their own.
    void run(int steps, double sharpness, std::vector<AppearanceStep>& history);
    /// Takes further steps until the constraints hold closely, but not many.
    void settle(double sharpness, std::vector<AppearanceStep>& history);
    void begin(std::vector<double> design);
    const std::vector<double>& design() const { return design_; }
    void write(AppearanceResult& result);

  private:
    struct Analysis {
        Compliance<2>::Result structure;
        double appearance = 0, volume = 0, greyness = 0;
        std::vector<double> appearance_gradient;
    };
    Compliance<2>::Result analyse_structure(const std::vector<double>& design, double sharpness);
    Analysis analyse(Compliance<2>::Result structure);
    std::vector<double> wished_design(Mma& mma, const Analysis& found) const;
    Analysis step_towards(const std::vector<double>& wish, double present, double sharpness);
    bool is_feasible(const Analysis& found) const;
    std::span<const double> density() const { return map_.density(DensityMap::Role::result); }
    double most_compliance() const { return settings_.compliance * least_compliance_; }
    double move(double sharpness) const;
    Mma make_mma(double move) const;
    void take_step(Mma& mma, double sharpness, std::vector<AppearanceStep>& history);

    const TopologyProblem<2>& problem_;
    const AppearanceSettings& settings_;
    int level_;
    double least_compliance_;
    DensityMap map_;
    Compliance<2> compliance_;
    Appearance appearance_;
    DesignBounds bounds_;
    std::vector<double> free_;
    double elements_ = 0;  ///< not outside
    std::vector<double> design_;
    Analysis found_;  ///< of the design
    int steps_ = 0;
    double first_appearance_ = 0;
};

LevelOptimizer::LevelOptimizer(const TopologyProblem<2>& problem, const GreyImage& exemplar,
                               const AppearanceSettings& settings, int level, double least_compliance)
    : problem_(problem),
      settings_(settings),
      level_(level),
      least_compliance_(least_compliance),
      map_(problem.body.grid.elements(), problem.use, eroded_settings(settings)),
      compliance_(problem, {.tolerance = settings.solver_tolerance, .cancel = settings.cancel},
                  settings.shared),
      appearance_(exemplar, map_.size().x, map_.size().y, settings.match, level, prescribed(problem.use)),
      bounds_(design_bounds(problem)) {
    for (const ElementUse use : problem.use) {
        const bool is_free = use == ElementUse::free;
        free_.push_back(is_free ? 1.0 : 0.0);
        elements_ += use != ElementUse::outside ? 1 : 0;
    }
}

void LevelOptimizer::begin(std::vector<double> design) {
    for (std::size_t i = 0; i < design.size(); ++i)
        design[i] = std::clamp(design[i], bounds_.lower[i], bounds_.upper[i]);
    design_ = std::move(design);
}

Compliance<2>::Result LevelOptimizer::analyse_structure(const std::vector<double>& design, double sharpness) {
    stop_if_cancelled(settings_.cancel);
    map_.forward(design, sharpness);
    return compliance_.evaluate(map_.density(DensityMap::Role::stiffness));
}

LevelOptimizer::Analysis LevelOptimizer::analyse(Compliance<2>::Result structure) {
    stop_if_cancelled(settings_.cancel);
    Analysis found;
    found.structure = std::move(structure);
    appearance_.match(density());
    found.appearance_gradient.resize(design_.size());
    found.appearance = appearance_.energy(density(), found.appearance_gradient);
    found.volume = sum_of(density()) / elements_;
    const std::span<const double> rho = density();
    const double grey = sum_over_variables<double>(
        rho.size(), [&](std::size_t i, double& sum) { sum += free_[i] * 4 * rho[i] * (1 - rho[i]); });
    found.greyness = grey / sum_of(free_);
    return found;
}

std::vector<double> LevelOptimizer::wished_design(Mma& mma, const Analysis& found) const {
    using Role = DensityMap::Role;
    const auto gradient = [&](Role role, std::span<const double> by_density, double scale) {
        std::vector<double> by_design = map_.backward(role, by_density);
        for (double& g : by_design) g *= scale;
        return by_design;
    };
    const double most = most_compliance(), n = elements_;
    const auto objective =
        gradient(Role::result, found.appearance_gradient, function_scale / first_appearance_);
    std::vector<double> constraints{function_scale * (found.structure.total / most - 1),
                                    function_scale * (found.volume / settings_.volume - 1)};
    std::vector<std::vector<double>> gradients{
        gradient(Role::stiffness, found.structure.gradient, function_scale / most),
        gradient(Role::result, free_, function_scale / (settings_.volume * n))};
    if (settings_.volume_min > 0) {
        constraints.push_back(function_scale * (1 - found.volume / settings_.volume_min));
        gradients.push_back(gradient(Role::result, free_, -function_scale / (settings_.volume_min * n)));
    }
    return mma
        .update({.x = design_,
                 .lower = bounds_.lower,
                 .upper = bounds_.upper,
                 .objective_gradient = objective,
                 .constraints = constraints,
                 .gradients = {gradients.begin(), gradients.end()}})
        .x;
}

/// Goes towards a design, half as far as long as the structure would break: where a thin line of solid parts,
/// compliance leaps, and no approximation foresees it.
LevelOptimizer::Analysis LevelOptimizer::step_towards(const std::vector<double>& wish, double present,
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
        if (structure && (structure->total <= bound || halvings == most_halvings)) {
            design_ = std::move(next);
            return analyse(std::move(*structure));
        }
        for (std::size_t i = 0; i < next.size(); ++i) next[i] = 0.5 * (next[i] + design_[i]);
    }
}

Mma LevelOptimizer::make_mma(double move) const {
    return {design_.size(), settings_.volume_min > 0 ? std::size_t{3} : std::size_t{2}, {.move = move}};
}

/// A sharp projection turns a small change of the design into a large one of the densities.
double LevelOptimizer::move(double sharpness) const {
    return settings_.move / std::sqrt(std::max(1.0, sharpness));
}

void LevelOptimizer::take_step(Mma& mma, double sharpness, std::vector<AppearanceStep>& history) {
    AppearanceStep step{.level = level_,
                        .index = ++steps_,
                        .appearance = found_.appearance,
                        .compliance = found_.structure.total / least_compliance_,
                        .volume = found_.volume,
                        .greyness = found_.greyness,
                        .sharpness = sharpness,
                        .solver_iterations = found_.structure.iterations};
    if (first_appearance_ == 0) first_appearance_ = found_.appearance;
    const std::vector<double> former = design_;
    found_ = step_towards(wished_design(mma, found_), found_.structure.total, sharpness);
    for (std::size_t i = 0; i < former.size(); ++i)
        step.change = std::max(step.change, std::abs(design_[i] - former[i]));
    history.push_back(step);
    if (settings_.report) settings_.report(step);
}

void LevelOptimizer::run(int steps, double sharpness, std::vector<AppearanceStep>& history) {
    Mma mma = make_mma(move(sharpness));
    found_ = analyse(analyse_structure(design_, sharpness));
    for (int k = 0; k < steps; ++k) take_step(mma, sharpness, history);
}

bool LevelOptimizer::is_feasible(const Analysis& found) const {
    return found.structure.total <= (1 + compliance_settled) * most_compliance() &&
           found.volume <= (1 + volume_settled) * settings_.volume &&
           found.volume >= (1 - volume_settled) * settings_.volume_min;
}

void LevelOptimizer::settle(double sharpness, std::vector<AppearanceStep>& history) {
    Mma mma = make_mma(settling_move * move(sharpness));
    for (int k = 0; k < most_settling_steps && !is_feasible(found_); ++k) take_step(mma, sharpness, history);
}

void LevelOptimizer::write(AppearanceResult& result) {
    result.use = problem_.use;
    result.density.assign(density().begin(), density().end());
    map_.forward(design_, 0);
    result.filtered.assign(density().begin(), density().end());
    result.design = design_;
    result.appearance = found_.appearance;
    result.compliance = found_.structure.total;
    result.volume = found_.volume;
    result.greyness = found_.greyness;
    result.least_compliance = least_compliance_;
}

TopologySettings topology_settings(const AppearanceSettings& settings, int steps) {
    TopologySettings stiff;
    stiff.density = density_settings(settings);
    stiff.method = TopologyMethod::mma;
    stiff.move = settings.move;
    stiff.tolerance = 0;  // as many steps in any case
    stiff.iterations = steps;
    stiff.solver_tolerance = settings.solver_tolerance;
    stiff.cancel = settings.cancel;
    stiff.shared = settings.shared;
    return stiff;
}

/// The designs that go from a level to the next, and where they lie.
struct LevelDesigns {
    glm::ivec3 size{0};
    std::vector<ElementUse> use;
    std::vector<double> stiffest, pictured;
};

/// Puts in the place of each design, but for prescribed elements, what the level before made of it.
void refine(LevelDesigns& now, const LevelDesigns& former) {
    const auto first_free =
        static_cast<std::size_t>(std::ranges::find(now.use, ElementUse::free) - now.use.begin());
    const double start = now.pictured.at(first_free);
    for (const auto design : {&LevelDesigns::stiffest, &LevelDesigns::pictured}) {
        const std::vector<double> finer =
            upsampled_design({former.size, former.use, former.*design}, now.size, now.use, start);
        for (std::size_t i = 0; i < finer.size(); ++i) {
            if (now.use[i] == ElementUse::free) (now.*design)[i] = finer[i];
        }
    }
}

int steps_at(const AppearanceSettings& settings, int level) { return ((settings.steps - 1) >> level) + 1; }

/// Returns how sharp the projection is, one time after the other.
std::vector<double> sharpnesses(const AppearanceSettings& settings) {
    std::vector<double> list;
    for (double sharpness = 0.5; sharpness < settings.sharpness;)
        list.push_back(sharpness = std::min(2 * sharpness, settings.sharpness));
    return list;
}

}  // namespace

int step_count(const AppearanceSettings& settings) {
    int steps = static_cast<int>(sharpnesses(settings).size()) * settings.steps_a_sharpness;
    for (int level = 0; level < settings.levels; ++level) steps += steps_at(settings, level);
    return steps;
}

AppearanceResult optimize_appearance(const PlaneProblemMaker& make_problem, glm::ivec3 size,
                                     const GreyImage& exemplar, int exemplar_width,
                                     const AppearanceSettings& settings) {
    check(settings, exemplar_width);
    std::vector<glm::ivec3> sizes{{size.x, size.y, 1}};
    while (static_cast<int>(sizes.size()) < settings.levels)
        sizes.insert(sizes.begin(), halved_size(sizes.front()));

    AppearanceResult result;
    std::optional<LevelDesigns> former;
    for (int level = 0; level < settings.levels; ++level) {
        const glm::ivec3 at = sizes[static_cast<std::size_t>(level)];
        const int edge = 1 << (settings.levels - 1 - level);
        const int steps = steps_at(settings, level);
        TopologyProblem<2> problem = make_problem(at, edge);
        if (problem.body.grid.elements() != at)
            throw InputError("appearance: the problem's grid is not of the size that was asked for");
        problem.volume = settings.volume;

        TopologyOptimizer<2> topology(problem, topology_settings(settings, steps));
        LevelDesigns now{at, problem.use, topology.state().design, topology.state().design};
        if (former) {
            refine(now, *former);
            TopologyState state;
            state.design = now.stiffest;
            topology.set_state(std::move(state));
        }
        while (!topology.is_finished()) topology.iterate();
        now.stiffest = topology.state().design;
        const double least_compliance = topology.analyse().total;

        const GreyImage scaled = box_filtered(exemplar, std::max(1, (exemplar_width + edge / 2) / edge));
        LevelOptimizer optimizer(problem, scaled, settings, level, least_compliance);
        optimizer.begin(now.pictured);
        optimizer.run(steps, 0, result.history);
        now.pictured = optimizer.design();
        former = std::move(now);
        if (level + 1 < settings.levels) continue;

        for (const double sharpness : sharpnesses(settings))
            optimizer.run(settings.steps_a_sharpness, sharpness, result.history);
        optimizer.settle(settings.sharpness, result.history);
        optimizer.write(result);
        const auto stiffest = topology.densities().density(DensityMap::Role::result);
        result.stiffest.assign(stiffest.begin(), stiffest.end());
        Appearance own(scaled, at.x, at.y, settings.match, level, prescribed(problem.use));
        own.match(stiffest);
        result.stiffest_appearance = own.energy(stiffest);
    }
    return result;
}

}  // namespace lamella
