// Structure and appearance: the shape that looks most like an exemplar among those that are stiff enough.
#pragma once

#include <functional>

#include "procedural/appearance/patch_match.h"
#include "procedural/optimization/shared_solves.h"
#include "procedural/optimization/topology_problem.h"

namespace lamella {

/// What a step found, before it changed the design.
struct AppearanceStep {
    int level = 0;          ///< 0 is the coarsest
    int index = 0;          ///< in the level, from 1
    double appearance = 0;  ///< A, with the matches of this step
    double compliance = 0;  ///< C / C_opt of the level
    double volume = 0;      ///< mean density
    double greyness = 0;    ///< mean of 4 rho (1 - rho) over free elements
    double change = 0;      ///< largest change of a variable that the step made
    double sharpness = 0;   ///< of the projection
    int solver_iterations = 0;
};

struct AppearanceSettings {
    double compliance = 1.2;  ///< most, as a multiple of C_opt: 1 and more
    double volume = 0.4;    ///< most of the mean density of elements that are not outside; above 0, at most 1
    double volume_min = 0;  ///< least, from 0 to `volume`
    MatchSettings match;
    int levels = 3;                  ///< grids; each has elements twice as wide as the next. 1 to 8
    int steps = 40;                  ///< at the coarsest level; each level has half as many as that before
    double radius = 1.5;             ///< of the density filter, elements of each level
    std::array<bool, 3> mirrored{};  ///< symmetry across the middle of the grid, by axis
    double sharpness = 16;           ///< of the projection at the end; comes on at 1 and doubles. 0: none
    int steps_a_sharpness = 10;
    double move = 0.2;                                  ///< most change of a variable in a step
    double solver_tolerance = 1e-5;                     ///< relative residual; at 1e-4 thin members break off
    std::function<void(const AppearanceStep&)> report;  ///< called after each step; may be empty
    const CancelToken* cancel = nullptr;                ///< may be null
    SharedSolves* shared = nullptr;                     ///< see TopologySettings
};

/// Returns the number of steps on all grids and with all projections, without those that settle the
/// constraints.
int step_count(const AppearanceSettings& settings);

/// Makes the problem on a grid of `size` elements of a width of `edge` elements of the finest grid. All grids
/// have the same middle; a coarse one may stand out by half an element. The problem's volume is not read.
using PlaneProblemMaker = std::function<TopologyProblem<2>(glm::ivec3 size, int edge)>;

/// Fields are those of the finest grid, x fastest.
struct AppearanceResult {
    std::vector<ElementUse> use;
    std::vector<double> density;   ///< projected
    std::vector<double> filtered;  ///< before projection, 0 and 1 where prescribed
    std::vector<double> design;
    double appearance = 0;  ///< A of the densities
    double compliance = 0;  ///< C of the eroded densities, in the units of the problem
    double volume = 0;      ///< mean density
    double greyness = 0;
    /// The stiffest densities of the same volume, without projection.
    std::vector<double> stiffest;
    double least_compliance = 0;     ///< C_opt of the finest grid
    double stiffest_appearance = 0;  ///< A of the stiffest densities
    std::vector<AppearanceStep> history;
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
/// A pure function of its arguments: the same bits on any number of threads. Throws InputError for settings
/// out of range, an exemplar or a grid smaller than a window at the coarsest level, and a problem that
/// TopologyOptimizer refuses; Interrupted once cancelled.
AppearanceResult optimize_appearance(const PlaneProblemMaker& problem, glm::ivec3 size,
                                     const GreyImage& exemplar, int exemplar_width,
                                     const AppearanceSettings& settings);

}  // namespace lamella
