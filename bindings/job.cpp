// Builds jobs from recipes, with surveys, supports and copies.
#include <algorithm>
#include <cmath>

#include "bindings/handles.h"
#include "recipe/build/finish_job.h"
#include "recipe/output/job_picture.h"
#include "recipe/output/plated_job.h"
#include "recipe/structure/structure_report.h"

namespace lamella {

std::function<void(const char*, const Progress&)> progress_to(lamella_on_progress callback, void* user) {
    if (callback == nullptr) return {};
    return [callback, user](const char* what, const Progress& progress) {
        check_callback(callback(user, what, progress.done, progress.total),
                       "the program's progress callback");
    };
}

lamella_job_info job_info(const Job& job) {
    lamella_job_info info{};
    info.layer_count = job.layers.count();
    for (int axis = 0; axis < 3; ++axis) {
        info.lower[axis] = job.bounds.lo[axis];
        info.upper[axis] = job.bounds.hi[axis];
    }
    info.layer_height = job.layers.height(0);
    info.has_supports = job.supports != nullptr;
    info.name = job.name.c_str();
    info.identity = job.identity.c_str();
    return info;
}

}  // namespace lamella

using namespace lamella;

namespace {

/// Makes what a recipe asks for: search, surveys, supports and copies.
void make(const lamella_build_options& options, lamella_job& made) {
    const Recipe recipe = first_piece(made.recipe);
    OptimizeOptions optimizing;
    optimizing.plans = options.plans ? options.plans : "";
    optimizing.threads = options.threads;
    optimizing.cancel = options.cancel ? &options.cancel->token : nullptr;
    const auto on_progress = progress_to(options.progress, options.user);
    if (on_progress) {
        optimizing.on_iteration = [&](const OptimizationStep& step, int steps) {
            on_progress("optimisation", {step.index, std::max(steps, step.index)});
        };
    }
    made.built = build_job(recipe, optimizing);
    stop_if_cancelled(optimizing.cancel);  // a search that was cancelled ends with its best so far
    FinishOptions finish;
    finish.plans = optimizing.plans;
    finish.threads = options.threads;
    finish.on_progress = on_progress;
    finish.cancel = optimizing.cancel;
    const SupportStructures around = finish_job(recipe, made.built, finish);
    add_picture(recipe, made.built, around.supports, options.threads);
    std::vector<PlateItem> items{{std::move(made.built.job), recipe.plate.copies}};
    for (const Recipe& piece : other_pieces(made.recipe, made.built.pieces)) {
        BuiltJob beside = build_job(piece, optimizing);
        finish_job(piece, beside, finish);
        items.push_back({std::move(beside.job), piece.plate.copies});
    }
    made.job = put_on_plates(recipe, items, {options.threads, {}, optimizing.cancel}).job;
}

const lamella_job& job_of(const lamella_job* job) { return wanted(job, "job"); }

}  // namespace

std::int32_t lamella_cancel_create(lamella_context* context, lamella_cancel** cancel) {
    return guarded(context, [&] {
        lamella_cancel*& made = wanted(cancel, "cancel");
        made = new lamella_cancel;
    });
}

void lamella_cancel_destroy(lamella_cancel* cancel) { delete cancel; }

void lamella_cancel_request(lamella_cancel* cancel) {
    if (cancel != nullptr) cancel->token.cancel();
}

std::int32_t lamella_job_build(lamella_context* context, const lamella_recipe* recipe,
                               const lamella_build_options* options, lamella_job** job) {
    return guarded(context, [&] {
        wanted(job, "job");
        const lamella_build_options with = taken_or_usual(options, "options");
        if (with.threads < 0) throw BadCall("options: threads is below 0");
        RecipeDraft draft = wanted(recipe, "recipe").draft;
        draft.use_profiles(recipe->profiles);
        for (const auto& [setting, text] : recipe->set) draft.assign_flag(*setting, text, setting->name());
        auto made = std::make_unique<lamella_job>();
        made->recipe = draft.finish();
        made->profiles = recipe->profiles;
        make(with, *made);
        *job = made.release();
    });
}

void lamella_job_destroy(lamella_job* job) { delete job; }

std::int32_t lamella_job_info_get(lamella_context* context, const lamella_job* job, lamella_job_info* info) {
    return guarded(context, [&] { hand_out(info, job_info(job_of(job).job), "info"); });
}

std::int32_t lamella_job_layer_z(lamella_context* context, const lamella_job* job, std::int32_t layer,
                                 double* z) {
    return guarded(context, [&] {
        const Job& made = job_of(job).job;
        if (layer < 0 || layer >= made.layers.count()) throw BadCall("layer: the job has no such layer");
        wanted(z, "z") = made.plane(layer);
    });
}

std::int32_t lamella_job_layer_height(lamella_context* context, const lamella_job* job, std::int32_t layer,
                                      double* height) {
    return guarded(context, [&] {
        const Job& made = job_of(job).job;
        if (layer < 0 || layer >= made.layers.count()) throw BadCall("layer: the job has no such layer");
        wanted(height, "height") = made.layers.height(layer);
    });
}

std::int32_t lamella_job_values(lamella_context* context, const lamella_job* job, const double* points,
                                std::size_t count, double* values) {
    return guarded(context, [&] {
        const Field& part = *job_of(job).job.part;
        if (count == 0) return;
        wanted(points, "points");
        wanted(values, "values");
        for (std::size_t i = 0; i < count; ++i) {
            const dvec3 p{points[3 * i], points[3 * i + 1], points[3 * i + 2]};
            if (!std::isfinite(p.x + p.y + p.z)) throw BadCall("points: one is not finite");
            values[i] = part.value(p);
        }
    });
}
