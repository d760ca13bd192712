// Which way up a recipe's part is best printed.
#pragma once

#include <cstdint>
#include <vector>

#include "procedural/orientation/best_orientations.h"
#include "recipe/recipe.h"

namespace lamella {

/// What an orientation is chosen for.
enum class OrientGoal : std::uint8_t {
    supports,  ///< little material of supports
    height,    ///< few layers
    surface,   ///< little surface that supports or the bed touch
    area       ///< small layers, which resin machines peel off more easily
};

struct OrientOptions {
    OrientGoal goal = OrientGoal::supports;
    std::size_t count = 10;               ///< orientations to return
    int threads = 0;                      ///< 0: one per core
    const CancelToken* cancel = nullptr;  ///< may be null
};

struct Orientation {
    OrientationFigures figures;
    dvec3 lay_on{0};  ///< for part.lay_on: the direction of the part that points down
};

struct OrientReport {
    Orientation now;                ///< as the recipe turns the part
    std::vector<Orientation> best;  ///< the best first, at least ten degrees from each other
};

/// Measures and searches orientations of the part's body on its machine, with pillars below overhangs. A pure
/// function of the recipe. Throws InputError when the body cannot be made, Interrupted when cancelled.
OrientReport orient_part(const Recipe& recipe, const OrientOptions& options);

}  // namespace lamella
