// Builds jobs from recipes: the part as one field, cut into layers.
#pragma once

#include <optional>

#include "engine/checks/print_check.h"
#include "engine/layers/layer.h"
#include "engine/surveys/island_survey.h"
#include "engine/surveys/piece_joins.h"
#include "engine/surveys/tip_survey.h"
#include "procedural/elements/element_plan.h"
#include "recipe/build/build_body.h"
#include "recipe/build/build_enclosure.h"
#include "recipe/build/build_foam.h"
#include "recipe/build/build_regions.h"
#include "recipe/build/build_skin.h"
#include "recipe/build/modulus_report.h"
#include "recipe/build/place_dowels.h"
#include "recipe/build/place_drains.h"
#include "recipe/layering/plan_layers.h"
#include "recipe/recipe.h"
#include "recipe/structure/optimize_part.h"

namespace lamella {

/// Results of repairs; empty for those that were not asked for.
struct RepairReport {
    std::optional<JoinSurvey> joins;
    std::optional<CheckResult> thickened, filled;  ///< findings before the repair
    std::optional<TipSurvey> tips;
    double trim = 0;          ///< mm: up to which tips were trimmed
    std::vector<Beam> holds;  ///< struts from tips that stay down to the part, as printed
};

struct BuiltJob {
    Job job;                                 ///< the job to print
    Job designed;                            ///< before [process]; its layers correspond to `layers`
    PartLayers layers;                       ///< of the printed part, without a lift
    glm::dmat3 axes{1};                      ///< orthogonal: turn the part as it was designed into the job's
    FieldPtr body;                           ///< the part without foam and skin
    std::optional<OptimizedPart> optimized;  ///< empty unless the recipe optimises
    std::optional<ElementPlan> elements;     ///< empty unless the part is built of elements
    FieldPtr outside;                        ///< the body, including a skin outside it
    std::optional<BuiltFoam> foam;           ///< empty without foam
    std::optional<ModulusReport> modulus;    ///< empty when the foam's stiffness is unknown
    std::optional<GradedUse> skin;           ///< empty when the skin's thickness is constant
    std::optional<MeshReport> mesh;          ///< empty for shapes and fields
    std::optional<PatternReport> pattern;    ///< empty when the skin is closed
    std::vector<DrilledHole> holes;          ///< of the recipe's [[hole]] entries
    std::optional<DrainReport> drains;       ///< empty when none are asked for
    std::optional<DowelHoles> dowels;        ///< empty when none are asked for
    std::optional<HollowReport> cavities;    ///< empty when none are asked for
    int pieces = 1;                          ///< that cuts make of the part
    FieldPtr before_cavities;                ///< the designed part before hollowing; null without cavities
    BuiltRegions regions;
    std::optional<IslandReport> islands;  ///< empty before drop_islands
    std::optional<RepairReport> repairs;  ///< empty before repair_job
};

/// Builds the job of a recipe. Surveys all layers when the recipe asks for cavities (for space inside the
/// part), drains (for closed cavities) or dowels (for places inside all layers). Optimises first when the
/// recipe asks for it. A part that is cut is built as the piece that plate.piece names, or whole where that
/// is 0: see first_piece() and other_pieces(). Throws InputError when a file is unreadable, the part is empty
/// or cannot be optimised.
/// ```
///     const Recipe recipe = read_recipe("part.toml", MachineProfiles());
///     BuiltJob built = build_job(recipe);
///     const SupportStructures added = finish_job(recipe, built, {});
///     const auto backend = make_backend(recipe.printer, "part.sl1", false);
///     StreamOptions options;
///     options.range = {0, built.job.layers.count()};
///     const StreamReport report = stream_layers(built.job, *backend, options);
/// ```
BuiltJob build_job(const Recipe& recipe, const OptimizeOptions& optimizing = {});

/// Returns the recipe of the first of the pieces that the recipe's cuts make, and those of the others, this
/// many in all; the recipe itself, and none, where it has no cuts or names a piece.
Recipe first_piece(const Recipe& recipe);
std::vector<Recipe> other_pieces(const Recipe& recipe, int pieces);

/// Removes disconnected pieces (islands) from the part after a survey of all layers. The row spacing is the
/// recipe's, or else a third of the thinnest beam's radius (of half the thinnest wall), clamped to the range
/// of the survey. Throws InputError when the recipe's spacing does not suit the part, Interrupted when
/// cancelled.
void drop_islands(const Recipe& recipe, BuiltJob& built, IslandSurveyOptions options);

/// Makes the foam of a recipe without its part, as build_foam does. Throws InputError when it has a frame,
/// which needs the part.
BuiltFoam build_foam_alone(const Recipe& recipe, const Box& region, std::int64_t repeats_after = 0);

}  // namespace lamella
