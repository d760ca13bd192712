// Does what the commands do, and tells an analysis how far it is.
#include "app/jobs/analysis_work.h"

#include <utility>

#include "app/jobs/design_volume.h"
#include "app/jobs/recipe_mistakes.h"
#include "app/ranks/distribute_solves.h"
#include "app/reports/stiffness_report.h"
#include "app/reports/structure_text.h"
#include "recipe/build/build_job.h"
#include "recipe/build/support_plan.h"

namespace lamella {

namespace {

void homogenize_job(const ServedJob& job, StiffnessOptions options, Analysis& analysis) {
    options.cancel = &analysis.cancel();
    const FoamRecipe& foam = *job.recipe.foam;
    const std::vector<StiffnessSolve> solves = foam_solves(job.recipe, options);
    DistributedSolves solving(nullptr, job.recipe, solves, options);
    const FoamStiffness found =
        foam_stiffness(solving.next(solves.size(), [&](double share) { analysis.set_share(share); }));
    solving.finish();
    nlohmann::ordered_json result = stiffness_json(foam, options.material, found);
    result["directions"] = directional_json(found.stiffness());
    result["law"] = law_json(foam);
    analysis.set_result(std::move(result));
}

void optimize_recipe(const Recipe& recipe, bool resume, int threads, Analysis& analysis) {
    const bool is_foam = drives_foam(recipe.optimize->result);
    OptimizeOptions options;
    options.plans = default_plan_folder();
    options.anew = true;
    options.resume = resume;
    options.threads = threads;
    options.cancel = &analysis.cancel();
    options.on_iteration = [&](const OptimizationStep& step, int steps) {
        analysis.add_step(step_json(step), steps);
    };
    options.on_design = [&](const SearchedDesign& design) {
        if (analysis.wants_design()) analysis.set_design(design_volume(design, is_foam));
    };
    const BuiltJob built = build_job(recipe, options);
    analysis.set_result(structure_json(*built.optimized->report));
    analysis.set_design(design_volume(*built.optimized, is_foam));
    if (analysis.cancel().cancelled())
        throw Interrupted("stopped; the report is that of the best design so far");
}

}  // namespace

std::function<void(Analysis&)> homogenize_work(std::shared_ptr<const ServedJob> job,
                                               StiffnessOptions options) {
    options.material = homogenized_material(job->recipe);
    return [job = std::move(job), options](Analysis& analysis) { homogenize_job(*job, options, analysis); };
}

std::function<void(Analysis&)> optimize_work(const std::string& text, const ServedFolder& folder, bool resume,
                                             int threads) {
    const Recipe recipe = first_piece(read_served_recipe(text, folder));
    check_is_optimized(recipe);
    return [recipe, name = served_recipe_name(folder), resume, threads](Analysis& analysis) {
        try {
            optimize_recipe(recipe, resume, threads, analysis);
        } catch (const InputError& error) {
            throw RecipeMistakes(error.what(), name);
        }
    };
}

}  // namespace lamella
