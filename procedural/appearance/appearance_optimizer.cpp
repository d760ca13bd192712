// The way through the levels: stiffest design, steps without projection, and with ever sharper ones.
#include "procedural/appearance/appearance_optimizer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "procedural/appearance/design_upsampling.h"

namespace lamella {
namespace {

constexpr int most_levels = 8;
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

TopologySettings topology_settings(const AppearanceSettings& settings, int steps) {
    TopologySettings stiff;
    stiff.density = plain_density_settings(settings);
    stiff.method = TopologyMethod::mma;
    stiff.move = settings.move;
    stiff.tolerance = 0;  // as many steps in any case
    stiff.iterations = steps;
    stiff.solver_tolerance = settings.solver_tolerance;
    stiff.shared = settings.shared;
    return stiff;
}

/// Returns a design of a finer grid: `start`, with what the coarse one says of the elements that are free.
std::vector<double> refined_design(const PlaneDesign& coarse, glm::ivec3 size,
                                   const TopologyProblem<2>& problem, std::vector<double> start) {
    const std::vector<ElementUse>& use = problem.use;
    const auto first_free = static_cast<std::size_t>(std::ranges::find(use, ElementUse::free) - use.begin());
    const std::vector<double> finer = upsampled_design(coarse, size, use, start.at(first_free));
    for (std::size_t i = 0; i < finer.size(); ++i) {
        if (use[i] == ElementUse::free) start[i] = finer[i];
    }
    return start;
}

std::vector<double> within_bounds(std::vector<double> design, const TopologyProblem<2>& problem) {
    const DesignBounds bounds = design_bounds(problem);
    for (std::size_t i = 0; i < design.size(); ++i)
        design[i] = std::clamp(design[i], bounds.lower[i], bounds.upper[i]);
    return design;
}

int steps_at(const AppearanceSettings& settings, int level) { return ((settings.steps - 1) >> level) + 1; }

/// Returns how sharp the projection is, one time after the other.
std::vector<double> sharpnesses(const AppearanceSettings& settings) {
    std::vector<double> list;
    if (settings.sharpness > 0) list.push_back(std::min(1.0, settings.sharpness));
    while (!list.empty() && list.back() < settings.sharpness)
        list.push_back(std::min(2 * list.back(), settings.sharpness));
    return list;
}

std::vector<double> densities_of(const TopologyProblem<2>& problem, const DensitySettings& settings,
                                 const std::vector<double>& design, double sharpness) {
    DensityMap map(problem.body.grid.elements(), problem.use, settings);
    map.forward(design, sharpness);
    const std::span<const double> density = map.density(DensityMap::Role::result);
    return {density.begin(), density.end()};
}

}  // namespace

/// A grid, and what finds designs on it.
struct AppearanceOptimizer::Level {
    Level(int its_number, glm::ivec3 its_size, TopologyProblem<2> its_problem, GreyImage scaled)
        : number(its_number), size(its_size), problem(std::move(its_problem)), exemplar(std::move(scaled)) {}

    int number;
    glm::ivec3 size;
    TopologyProblem<2> problem;
    GreyImage exemplar;                            ///< a pixel an element
    std::optional<TopologyOptimizer<2>> topology;  ///< until the stiffest design is found
    std::optional<LevelOptimizer> optimizer;       ///< from then on
};

int step_count(const AppearanceSettings& settings) {
    int steps = static_cast<int>(sharpnesses(settings).size()) * settings.steps_a_sharpness;
    for (int level = 0; level < settings.levels; ++level) steps += steps_at(settings, level);
    return steps;
}

AppearanceOptimizer::AppearanceOptimizer(PlaneProblemMaker problem, glm::ivec3 size, GreyImage exemplar,
                                         int exemplar_width, const AppearanceSettings& settings)
    : make_problem_(std::move(problem)),
      exemplar_(std::move(exemplar)),
      exemplar_width_(exemplar_width),
      settings_(settings),
      sizes_{{size.x, size.y, 1}},
      sharpnesses_(sharpnesses(settings)) {
    check(settings_, exemplar_width);
    while (static_cast<int>(sizes_.size()) < settings_.levels)
        sizes_.insert(sizes_.begin(), halved_size(sizes_.front()));
    level_ = make_level(0, settings_.cancel);
    state_.pictured.design = level_->topology->state().design;
}

AppearanceOptimizer::~AppearanceOptimizer() = default;

std::unique_ptr<AppearanceOptimizer::Level> AppearanceOptimizer::make_level(int level,
                                                                            const CancelToken* cancel) const {
    const glm::ivec3 size = sizes_[static_cast<std::size_t>(level)];
    const int edge = 1 << (settings_.levels - 1 - level);
    GreyImage scaled = box_filtered(exemplar_, std::max(1, (exemplar_width_ + edge / 2) / edge));
    auto made = std::make_unique<Level>(level, size, make_problem_(size, edge), std::move(scaled));
    if (made->problem.body.grid.elements() != size)
        throw InputError("appearance: the problem's grid is not of the size that was asked for");
    made->problem.volume = settings_.volume;
    TopologySettings settings = topology_settings(settings_, steps_at(settings_, level));
    settings.cancel = cancel;
    made->topology.emplace(made->problem, settings);
    return made;
}

void AppearanceOptimizer::find_stiffest() {
    TopologyOptimizer<2>& topology = *level_->topology;
    while (!topology.is_finished()) topology.iterate();
    topology.set_state(topology.state());  // an analysis that was broken off leaves no trace
    const double least = topology.analyse().total;
    level_->optimizer.emplace(level_->problem, level_->exemplar, settings_, level_->number, least);
    state_.stiffest = {};
    state_.stiffest.design = topology.state().design;
    state_.least_compliance = least;
    state_.has_stiffest = true;
    level_->topology.reset();
}

void AppearanceOptimizer::go_to_next_level() {
    std::unique_ptr<Level> next = make_level(state_.level + 1, settings_.cancel);
    const std::vector<double> grey = next->topology->state().design;
    const auto finer = [&](const std::vector<double>& design) {
        return refined_design({level_->size, level_->problem.use, design}, next->size, next->problem, grey);
    };
    TopologyState stiffest;
    stiffest.design = finer(state_.stiffest.design);
    next->topology->set_state(std::move(stiffest));
    LevelState pictured;
    pictured.design = within_bounds(finer(state_.pictured.design), next->problem);
    pictured.found = std::move(state_.pictured.found);
    pictured.begin_stage();
    state_ = {.level = next->number,
              .stiffest = {},
              .least_compliance = state_.least_compliance,
              .pictured = std::move(pictured)};
    level_ = std::move(next);
}

double AppearanceOptimizer::sharpness() const {
    const std::size_t projections = sharpnesses_.size();
    if (state_.stage == 0 || projections == 0) return 0;
    return sharpnesses_[std::min(static_cast<std::size_t>(state_.stage), projections) - 1];
}

/// Returns the number of steps, in the last stage the largest one.
int AppearanceOptimizer::steps_of(int level, int stage) const {
    if (stage == 0) return steps_at(settings_, level);
    return stage == settling_stage() ? most_settling_steps : settings_.steps_a_sharpness;
}

/// A sharp projection turns a small change of the design into a large one of the densities.
LevelStage AppearanceOptimizer::stage() const {
    const double move = settings_.move / std::sqrt(std::max(1.0, sharpness()));
    return {sharpness(), state_.stage == settling_stage() ? settling_move * move : move};
}

/// Counts the step, and on the finest grid goes on to the next stage when it is time.
void AppearanceOptimizer::advance() {
    ++state_.stage_steps;
    if (!is_last(state_.level)) return;
    if (state_.stage != settling_stage() && stage_is_over()) {
        ++state_.stage;
        state_.stage_steps = 0;
        // Settling goes on from what was found.
        if (state_.stage == settling_stage()) {
            state_.pictured.mma = {};
        } else {
            state_.pictured.begin_stage();
        }
    }
    if (state_.stage == settling_stage())
        state_.finished = stage_is_over() || level_->optimizer->is_feasible(state_.pictured.found);
}

AppearanceStep AppearanceOptimizer::iterate() {
    if (!is_last(state_.level) && stage_is_over()) go_to_next_level();
    if (!state_.has_stiffest) find_stiffest();
    const AppearanceStep step = level_->optimizer->step(state_.pictured, stage());
    advance();
    return step;
}

AppearanceState AppearanceOptimizer::state() const {
    AppearanceState state = state_;
    if (!state.has_stiffest) state.stiffest = level_->topology->state();
    return state;
}

void AppearanceOptimizer::set_state(AppearanceState state) {
    const auto require_fit = [](bool fits) {
        if (!fits) throw InputError("the state of a search for an appearance does not fit the search");
    };
    require_fit(state.level >= 0 && state.level < settings_.levels && state.stage >= 0 &&
                state.stage <= (is_last(state.level) ? settling_stage() : 0) && state.stage_steps >= 0 &&
                state.stage_steps <= steps_of(state.level, state.stage) &&
                std::isfinite(state.least_compliance));
    std::unique_ptr<Level> level = make_level(state.level, settings_.cancel);
    const std::size_t count = level->problem.use.size();
    require_fit(state.pictured.design.size() == count && state.stiffest.design.size() == count);
    if (state.has_stiffest) {
        level->optimizer.emplace(level->problem, level->exemplar, settings_, level->number,
                                 state.least_compliance);
        level->optimizer->check(state.pictured);
        level->topology.reset();
    } else {
        level->topology->set_state(std::exchange(state.stiffest, {}));
    }
    level_ = std::move(level);
    state_ = std::move(state);
}

AppearanceResult AppearanceOptimizer::result() const {
    if (!has_result()) throw FaultError("a search for an appearance has no result before its first design");
    AppearanceResult result;
    result.appearance = state_.pictured.found.appearance;
    result.compliance = state_.pictured.found.compliance;
    result.volume = state_.pictured.found.volume;
    result.greyness = state_.pictured.found.greyness;
    result.least_compliance = state_.least_compliance;

    std::vector<double> stiffest = state().stiffest.design;
    result.stiffest = densities_of(level_->problem, plain_density_settings(settings_), stiffest, 0);
    Appearance own(level_->exemplar, level_->size.x, level_->size.y, settings_.match, level_->number,
                   prescribed_elements(level_->problem.use));
    own.match(result.stiffest);
    result.stiffest_appearance = own.energy(result.stiffest);

    result.design = state_.pictured.design;
    std::unique_ptr<Level> finer;  // than that of the search
    for (int number = state_.level; !is_last(number); ++number) {
        const Level& coarse = finer ? *finer : *level_;
        std::unique_ptr<Level> next = make_level(number + 1, nullptr);
        const std::vector<double> grey = next->topology->state().design;
        for (std::vector<double>* design : {&stiffest, &result.design})
            *design =
                refined_design({coarse.size, coarse.problem.use, *design}, next->size, next->problem, grey);
        finer = std::move(next);
    }
    const TopologyProblem<2>& finest = finer ? finer->problem : level_->problem;
    if (finer) result.stiffest = densities_of(finest, plain_density_settings(settings_), stiffest, 0);
    const DensitySettings eroded = eroded_density_settings(settings_);
    result.density = densities_of(finest, eroded, result.design, sharpness());
    result.filtered = densities_of(finest, eroded, result.design, 0);
    result.use = finest.use;
    return result;
}

}  // namespace lamella
