// Which way up a recipe's part is best printed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "procedural/orientation/best_orientations.h"
#include "recipe/recipe.h"

namespace lamella {

/// What an orientation is chosen for.
enum class OrientGoal : std::uint8_t {
    supports,  ///< little material of supports
    height,    ///< few layers
    surface,   ///< little surface that supports or the bed touch
    area,      ///< small layers, which resin machines peel off more easily
    strength   ///< loads along the layers, not across them
};

struct OrientOptions {
    OrientGoal goal = OrientGoal::supports;
    std::size_t count = 10;  ///< orientations to return
    /// Orientations to plan supports for, when they are the goal; empty: as many as take some seconds.
    std::optional<std::size_t> plan{};
    /// On the part as it was designed; empty: the forces of the recipe's [[load]]s.
    std::vector<dvec3> loads{};
    int threads = 0;                      ///< 0: one per core
    const CancelToken* cancel = nullptr;  ///< may be null
};

struct Orientation {
    OrientationFigures figures;
    dvec3 lay_on{0};                  ///< for part.lay_on: the direction of the part that points down
    std::optional<double> planned{};  ///< material of planned supports, mm^3; empty where none were planned
    std::optional<double> cups{};     ///< volume of suction cups, mm^3; empty where they do not matter
};

struct OrientReport {
    Orientation now;  ///< as the recipe turns the part
    /// The best first, at least ten degrees from each other: those with planned supports before the others.
    std::vector<Orientation> best;
    bool has_loads = false;  ///< figures of strength are of loads
};

/// Measures and searches orientations of the part's body on its machine, with pillars below overhangs. For
/// few supports, those of the best by estimate are planned as for a solid body (on bridges if the recipe says
/// so), and then those of neighbours of the best. For strength, ranks by whole percents of the loads across
/// the layers, and what is equal by the estimate. Measures the suction cups of the best on machines that
/// check them. A pure function of the recipe. Throws InputError when the body cannot be made, and for
/// strength without a load; Interrupted when cancelled.
OrientReport orient_part(const Recipe& recipe, const OrientOptions& options);

}  // namespace lamella
