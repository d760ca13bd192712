// Structure and appearance: the shape that looks most like an exemplar among those that are stiff enough.
#pragma once

#include <functional>
#include <memory>

#include "procedural/appearance/level_optimizer.h"

namespace lamella {

/// Returns the number of steps on all grids and with all projections, without those that settle the
/// constraints.
int step_count(const AppearanceSettings& settings);

/// Makes the problem on a grid of `size` elements of a width of `edge` elements of the finest grid. All grids
/// have the same middle; a coarse one may stand out by half an element. The problem's volume is not read.
using PlaneProblemMaker = std::function<TopologyProblem<2>(glm::ivec3 size, int edge)>;

/// What is needed to go on: plain data.
struct AppearanceState {
    int level = 0;
    bool has_stiffest = false;  ///< whether the stiffest design of the level is found
    TopologyState stiffest;     ///< once it is found, its design alone
    /// C_opt of the level; while its stiffest design is sought, that of the level before. 0: none yet.
    double least_compliance = 0;
    int stage = 0;        ///< 0: no projection; then one for each sharpness; at last, constraints settle
    int stage_steps = 0;  ///< made in it
    LevelState pictured;  ///< of the design that is to look like the exemplar
    bool finished = false;
};

/// What the present design makes. Fields are on the finest grid, x fastest.
struct AppearanceResult {
    std::vector<ElementUse> use;
    std::vector<double> density;   ///< projected
    std::vector<double> filtered;  ///< before projection, 0 and 1 where prescribed
    std::vector<double> design;
    // As the last step found it, on the grid of its level; 0 before the first step.
    double appearance = 0;  ///< A of the densities
    double compliance = 0;  ///< C of the eroded densities, in the units of the problem
    double volume = 0;      ///< mean density
    double greyness = 0;
    /// The stiffest densities of the same volume, without projection.
    std::vector<double> stiffest;
    double least_compliance = 0;     ///< C_opt, see AppearanceState
    double stiffest_appearance = 0;  ///< A of the stiffest densities, on the grid of the level
};

/// Structure and appearance optimisation (Martinez, Dumas, Lefebvre, Wei 2015, Structure and appearance
/// optimization for controllable shape design):
///
///     min A(rho)   subject to   C(rho) <= compliance C_opt,   volume_min <= mean rho <= volume
///
/// from uniform grey, on grids from coarse to fine, by the method of moving asymptotes. A is the energy of
/// Appearance, C the compliance, and C_opt that of TopologyOptimizer at the same volume on the same grid
/// after as many steps without projection. At each level the exemplar is scaled such that a pixel is an
/// element, its width being `exemplar_width` elements of the finest grid. At last, the projection comes on;
/// matches stay. C is that of the densities eroded a little, projected at 0.58 instead of 0.5: without that,
/// members hang on grey joints, which the shape, cut at 0.5, does not have.
///
/// Steps after which a thin strut would part are shortened. C and the volumes of the result miss their bounds
/// by at most 0.5 % and 0.25 %, unless 20 further steps do not get there.
///
/// Greys of the exemplar are copied as well, so it should be black_and_white() before it is scaled. Its lines
/// should be two elements wide or more at the coarsest level, and its solid share near `volume`.
///
/// A pure function of its arguments: the same bits on any number of threads, and whether or not it goes on
/// from a state.
class AppearanceOptimizer {
  public:
    /// Throws InputError for settings out of range and for a problem that TopologyOptimizer refuses.
    AppearanceOptimizer(PlaneProblemMaker problem, glm::ivec3 size, GreyImage exemplar, int exemplar_width,
                        const AppearanceSettings& settings);
    ~AppearanceOptimizer();
    AppearanceOptimizer(const AppearanceOptimizer&) = delete;
    AppearanceOptimizer& operator=(const AppearanceOptimizer&) = delete;

    /// Takes a step, and before the first one on a grid looks for its stiffest design. Throws InputError for
    /// an exemplar or a grid smaller than a window, and Interrupted once cancelled; state() has all that was
    /// done before.
    AppearanceStep iterate();
    bool is_finished() const { return state_.finished; }
    /// Whether result() has something to show: at least the stiffest design of the coarsest grid.
    bool has_result() const { return state_.least_compliance > 0; }
    /// Also before the end, and once cancelled: designs of coarse grids are interpolated. Throws FaultError
    /// without a result.
    AppearanceResult result() const;

    AppearanceState state() const;
    /// Goes on where another object was. Throws InputError for a state that does not fit.
    void set_state(AppearanceState state);

  private:
    struct Level;
    bool is_last(int level) const { return level + 1 == settings_.levels; }
    std::unique_ptr<Level> make_level(int level, const CancelToken* cancel) const;
    void find_stiffest();
    void go_to_next_level();
    void advance();
    int settling_stage() const { return static_cast<int>(sharpnesses_.size()) + 1; }
    int steps_of(int level, int stage) const;
    bool stage_is_over() const { return state_.stage_steps == steps_of(state_.level, state_.stage); }
    double sharpness() const;
    LevelStage stage() const;

    PlaneProblemMaker make_problem_;
    GreyImage exemplar_;
    int exemplar_width_;
    AppearanceSettings settings_;
    std::vector<glm::ivec3> sizes_;    ///< of the grids, from coarse to fine
    std::vector<double> sharpnesses_;  ///< of the projection, one time after the other
    std::unique_ptr<Level> level_;
    AppearanceState state_;
};

}  // namespace lamella
