// What a search for an appearance is asked for, and what each of its steps tells.
#pragma once

#include <array>

#include "procedural/appearance/patch_match.h"
#include "procedural/optimization/topology_optimizer.h"

namespace lamella {

/// What a step found, before it changed the design. `index` counts from 1 in the level, `compliance` is
/// C / C_opt of the level.
struct AppearanceStep : TopologyIteration {
    int level = 0;          ///< 0 is the coarsest
    double appearance = 0;  ///< A, with the matches of this step
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
    double move = 0.2;                    ///< most change of a variable in a step
    double solver_tolerance = 1e-5;       ///< relative residual; at 1e-4 thin members break off
    const CancelToken* cancel = nullptr;  ///< may be null
    SharedSolves* shared = nullptr;       ///< see TopologySettings
};

/// The densities of the stiffest design.
DensitySettings plain_density_settings(const AppearanceSettings& settings);

/// The densities of the design that is to look like the exemplar. The loads are borne by a projection at a
/// higher threshold: what is grey in the design is void there, so no member hangs on grey that the shape, cut
/// from the design, would not have.
DensitySettings eroded_density_settings(const AppearanceSettings& settings);

}  // namespace lamella
