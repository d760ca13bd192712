// Runs the surveys in their order.
#include "recipe/build/finish_job.h"

#include "recipe/build/assign_tools.h"
#include "recipe/build/repair_job.h"

namespace lamella {

SupportStructures finish_job(const Recipe& recipe, BuiltJob& built, const FinishOptions& options) {
    const auto progress_of = [&](const char* what) {
        return [&options, what](const Progress& progress) {
            if (options.on_progress) options.on_progress(what, progress);
        };
    };
    if (recipe.foam && recipe.foam->drop_islands) {
        IslandSurveyOptions survey;
        survey.threads = options.threads;
        survey.cancel = options.cancel;
        survey.on_progress = progress_of("islands");
        drop_islands(recipe, built, survey);
    }
    repair_job(recipe, built, {{options.threads, progress_of("repairs"), options.cancel}});
    SupportStructures around;
    around.supports = add_supports(
        recipe, built, {{options.threads, progress_of("supports"), options.cancel}, options.plans});
    around.shield = add_shield(recipe, built.job, {options.threads, options.cancel});
    assign_tools(recipe, built);
    return around;
}

}  // namespace lamella
