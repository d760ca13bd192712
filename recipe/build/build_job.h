// From a recipe to a job: the part as one field, cut into layers.
#pragma once

#include <optional>

#include "engine/checks/print_check.h"
#include "engine/layers/layer.h"
#include "engine/surveys/island_survey.h"
#include "engine/surveys/piece_joins.h"
#include "recipe/build/build_body.h"
#include "recipe/build/build_enclosure.h"
#include "recipe/build/build_foam.h"
#include "recipe/build/build_regions.h"
#include "recipe/build/build_skin.h"
#include "recipe/build/modulus_report.h"
#include "recipe/build/place_dowels.h"
#include "recipe/build/place_drains.h"
#include "recipe/recipe.h"

namespace lamella {

/// What repairs found and did; empty where they were not asked for.
struct RepairReport {
    std::optional<JoinSurvey> joins;
    std::optional<CheckResult> thickened, filled;  ///< as found before they were mended
};

struct BuiltJob {
    Job job;                               ///< what is printed
    Job designed;                          ///< the same before [process], layers cut alike
    FieldPtr body;                         ///< what the recipe's part is, without foam and skin
    FieldPtr outside;                      ///< the body, with a skin that lies outside it
    std::optional<BuiltFoam> foam;         ///< empty without foam
    std::optional<ModulusReport> modulus;  ///< empty where nothing is known of the foam's stiffness
    std::optional<GradedUse> skin;         ///< empty where the skin's thickness does not vary
    std::optional<MeshReport> mesh;        ///< empty for shapes and fields
    std::optional<PatternReport> pattern;  ///< empty where the skin is closed
    std::vector<DrilledHole> holes;        ///< that the recipe asks for
    std::optional<DrainReport> drains;     ///< empty where none are asked for
    std::optional<DowelHoles> dowels;      ///< empty where none are asked for
    std::optional<HollowReport> cavities;  ///< empty where none are asked for
    FieldPtr before_cavities;              ///< the designed part without them; null where none are asked for
    BuiltRegions regions;
    std::optional<IslandReport> islands;  ///< empty until they are looked for
    std::optional<RepairReport> repairs;  ///< empty until the job is repaired
};

/// Where cavities are asked for, the layers are surveyed for room inside the part; where drains are, for
/// cavities; where dowels are, for places inside all of them. Throws InputError when a file is unreadable or
/// the part is empty.
BuiltJob build_job(const Recipe& recipe);

/// Surveys the job's layers and leaves out of the part what floats free of it. The pitch is the recipe's, or
/// else a third of the thinnest beam's radius (of half the thinnest wall), as near as the survey takes it.
/// Throws InputError when a pitch of the recipe does not suit the part, Interrupted when cancelled.
void drop_islands(const Recipe& recipe, BuiltJob& built, IslandSurveyOptions options);

/// The foam of a recipe without its part, as build_foam makes it. Throws InputError when it has a frame,
/// which needs the part.
BuiltFoam build_foam_alone(const Recipe& recipe, const Box& region, std::int64_t repeats_after = 0);

}  // namespace lamella
