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
    /// Called before elements are placed with iteration 0, and after each iteration of a search; with the
    /// number of iterations. May be empty.
    std::function<void(const ElementIteration&, int iterations)> on_iteration{};
};

/// A part made of elements.
struct PlacedElements {
    ElementPlan plan;
    FieldPtr shape;  ///< the union of the elements and of solid regions, cut by the body or the shell
};

/// Returns whether the recipe's elements make its skin, and not its body.
bool has_skin_of_elements(const Recipe& recipe);

/// Places copies of the recipe's shapes in the body, or reads them from the plan folder when the same problem
/// was solved before: such that they bear the loads, or evenly where there are none. A pure function of the
/// recipe. Throws InputError for shapes that do not fit the body, a problem without a solution (see
/// structural_problem()), elements that do not reach all loads and anchors, or each other, and solid regions
/// that they do not join, Interrupted when cancelled.
PlacedElements place_elements(const Recipe& recipe, const FieldPtr& body, const BuiltRegions& regions,
                              Gradings& gradings, const PlaceElementsOptions& options);

/// Places copies of the recipe's shapes on the body's surface, evenly, in its tangent planes; outlines bend
/// with the shell, which is at most `depth` mm deep. Otherwise as place_elements().
PlacedElements place_elements_on_skin(const Recipe& recipe, const FieldPtr& body, const FieldPtr& shell,
                                      double depth, Gradings& gradings, const PlaceElementsOptions& options);

}  // namespace lamella
