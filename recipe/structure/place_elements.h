// Places elements in a part: from the recipe's [[element]], [elements], loads and anchors to their union.
#pragma once

#include "procedural/elements/element_optimizer.h"
#include "procedural/elements/element_plan.h"
#include "recipe/build/build_regions.h"

namespace lamella {

struct PlaceElementsOptions {
    std::filesystem::path plans{};        ///< folder for results; empty: none are read or kept
    int threads = 0;                      ///< 0: one per core
    const CancelToken* cancel = nullptr;  ///< may be null
    /// Called before the search with iteration 0, and after each iteration; with the number of iterations.
    /// May be empty.
    std::function<void(const ElementIteration&, int iterations)> on_iteration{};
};

/// A part made of elements.
struct PlacedElements {
    ElementPlan plan;
    FieldPtr shape;  ///< the union of the elements and of solid regions, cut by the body
};

/// Places copies of the recipe's shapes in the body, or reads them from the plan folder when the same problem
/// was solved before. A pure function of the recipe. Throws InputError for shapes that do not fit the body, a
/// problem without a solution (see structural_problem()), elements that do not reach all loads and anchors,
/// and solid regions that they do not join, Interrupted when cancelled.
PlacedElements place_elements(const Recipe& recipe, const FieldPtr& body, const BuiltRegions& regions,
                              Gradings& gradings, const PlaceElementsOptions& options);

}  // namespace lamella
