// Optimises a part: from the recipe's loads, anchors and [optimize] to the shape or foam that carries them.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/cancel_token.h"
#include "procedural/optimization/element_use.h"
#include "recipe/build/build_regions.h"

namespace lamella {

class DensityBricks;
class InputCache;
class SharedSolves;
struct ElementIteration;
struct OptimizationStep;
struct StructureReport;

/// The design of a search between two iterations, in the space in which the part is designed.
struct SearchedDesign {
    glm::ivec3 size{0};                            ///< elements along x, y and z; in the plane one along z
    Box box;                                       ///< of the elements, mm
    const std::vector<ElementUse>* use = nullptr;  ///< of each element, x fastest
    /// Returns the density of each element: above 0.5 is solid; of a foam its solid volume fraction.
    std::function<std::vector<double>()> densities;
};

struct OptimizeOptions {
    std::filesystem::path plans{};  ///< folder for results; empty: none are read or kept
    bool anew = false;              ///< optimises even if the folder has the result
    /// Goes on where a search of the same problem was cancelled, which the folder keeps. Throws InputError if
    /// it has none.
    bool resume = false;
    int threads = 0;  ///< 0: one per core
    /// Called after each iteration with the number of iterations at most; may be empty.
    std::function<void(const OptimizationStep&, int iterations)> on_iteration{};
    /// Called after on_iteration with the design, which lives as long as the call; may be empty.
    std::function<void(const SearchedDesign&)> on_design{};
    /// Ends the search with the best design so far, which is no plan, but kept for `resume`; may be null.
    const CancelToken* cancel = nullptr;
    /// Called before the pattern of a skin is synthesised, which may take minutes; may be empty.
    std::function<void()> on_pattern{};
    /// As in PlaceElementsOptions::on_iteration.
    std::function<void(const ElementIteration&, int iterations)> on_elements{};
    SharedSolves* shared = nullptr;  ///< the processes that share the load cases; null for one
    InputCache* inputs = nullptr;    ///< what former builds know of files; may be null
    bool as_designed = false;  ///< the job is that of the part before it is turned, mirrored or laid down
};

/// An optimised part.
struct OptimizedPart {
    /// Densities of the search's elements or of parts of them: above 0.5 is solid; of a foam its solid volume
    /// fraction. Smooth beyond the body.
    std::shared_ptr<const DensityBricks> densities;
    /// Of each density, x fastest, for pictures; empty when the result comes from a plan.
    std::vector<ElementUse> use;
    GradingPtr density;     ///< the densities as a grading
    GradingPtr foam_sizes;  ///< of the cells or members that are driven, mm; null without a foam
    FieldPtr dense;         ///< where the density is above 0.5, beyond the body, too
    FieldPtr shape;         ///< the body, cut to where it is solid; the body itself for other results
    std::shared_ptr<const StructureReport> report;  ///< null when the result comes from a plan
};

/// Optimises the body as the recipe says, or reads the result from the plan folder when the same problem was
/// solved before. A pure function of the recipe. Throws InputError for a problem without a solution (see
/// structural_problem), Interrupted when cancelled before there is a design to show: before the first
/// iteration ends, or, for an appearance, before the stiffest plate of the coarsest grid is found.
OptimizedPart optimize_part(const Recipe& recipe, const FieldPtr& body, const BuiltRegions& regions,
                            Gradings& gradings, const OptimizeOptions& options);

/// Returns the hash of all that the result depends on.
std::string optimize_hash(const Recipe& recipe);

/// Whether the plan folder has the result of the recipe's problem.
bool has_optimized(const Recipe& recipe, const std::filesystem::path& plans);

}  // namespace lamella
