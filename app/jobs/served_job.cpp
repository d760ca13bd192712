// Builds a job as `lamella slice` does, without a terminal.
#include "app/jobs/served_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_access.hpp>

#include "app/jobs/layer_content.h"
#include "app/jobs/part_numbers.h"
#include "app/jobs/part_structure.h"
#include "app/jobs/recipe_mistakes.h"
#include "printers/common/layer_heights.h"
#include "printers/process_limits.h"
#include "printers/registry.h"
#include "procedural/elements/element_optimizer.h"
#include "recipe/build/finish_job.h"
#include "recipe/build/json_triple.h"
#include "recipe/identity.h"
#include "recipe/keys/check_words.h"
#include "recipe/layering/plan_layers.h"
#include "recipe/output/job_picture.h"
#include "recipe/output/plated_job.h"
#include "recipe/read_recipe.h"
#include "recipe/structure/structure_report.h"

namespace lamella {

namespace {

std::uint64_t hash_of(const std::string& text) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash;
}

OptimizeOptions search_options(const BuildControl& control) {
    OptimizeOptions options;
    options.plans = default_plan_folder();
    options.threads = control.threads;
    options.cancel = control.cancel;
    options.inputs = control.inputs;
    if (!control.on_progress) return options;
    options.on_iteration = [&](const OptimizationStep& step, int steps) {
        control.on_progress("optimising", step.index, steps);
    };
    options.on_elements = [&](const ElementIteration& step, int steps) {
        control.on_progress("placing elements", step.index, steps);
    };
    options.on_pattern = [&] { control.on_progress("computing the pattern of the skin", 0, 1); };
    return options;
}

FinishOptions finish_options(const BuildControl& control) {
    FinishOptions options;
    options.threads = control.threads;
    options.cancel = control.cancel;
    if (control.on_progress) {
        options.on_progress = [&](const char* what, const Progress& progress) {
            control.on_progress(std::string("survey for ") + what, progress.done, progress.total);
        };
    }
    return options;
}

/// Builds one part, and appends it to the parts on the plate.
BuiltJob build_part(const Recipe& recipe, const BuildControl& control, std::optional<BuiltSupports>& supports,
                    std::vector<PlateItem>& items) {
    BuiltJob built = build_job(recipe, search_options(control));
    stop_if_cancelled(control.cancel);
    check_layer_heights(recipe.printer, built.job.layers.raised(lift_layers(recipe)));
    supports = finish_job(recipe, built, finish_options(control)).supports;
    add_picture(recipe, built, supports, control.threads);
    items.push_back({built.job, recipe.plate.copies});
    return built;
}

}  // namespace

std::string served_recipe_name(const ServedFolder& folder) {
    return (folder.path() / "recipe.toml").string();
}

Recipe read_served_recipe(const std::string& text, const ServedFolder& folder) {
    const std::string name = served_recipe_name(folder);
    try {
        RecipeDraft draft;
        draft.use_profiles(machine_profiles(""));
        draft.read_text(text, name);
        folder.check_recipe(text);  // before any file is opened
        return draft.finish();
    } catch (const InputError& error) {
        throw RecipeMistakes(error.what(), name);
    }
}

std::string served_job_id(const Recipe& recipe, const std::string& text, InputCache* inputs) {
    return job_identity(recipe, inputs) + fmt::format("-{:016x}", hash_of(text));
}

std::shared_ptr<const ServedJob> build_served_job(const std::string& text, const ServedFolder& folder,
                                                  const BuildControl& control) {
    auto served = std::make_shared<ServedJob>();
    const Recipe given = read_served_recipe(text, folder);
    try {
        served->id = served_job_id(given, text, control.inputs);
        served->recipe = first_piece(given);
        std::vector<PlateItem> items;
        served->built = build_part(served->recipe, control, served->supports, items);
        std::optional<BuiltSupports> unused;
        for (const Recipe& piece : other_pieces(given, served->built.pieces))
            build_part(piece, control, unused, items);
        PlatedJob plated = put_on_plates(given, items, {control.threads, {}, control.cancel});
        served->built.job = std::move(plated.job);
        served->plates = plated.plates;
        served->parts = std::max(1, static_cast<int>(served->job().objects.size()));
        stop_if_cancelled(control.cancel);
    } catch (const InputError& error) {
        throw RecipeMistakes(error.what(), served_recipe_name(folder));
    }
    return served;
}

std::shared_ptr<const PreviewScene> ServedJob::scene(int pixels, int threads) const {
    const std::lock_guard lock(scene_mutex_);
    // One that is much too fine would be slow.
    if (!scene_ || scene_pixels_ < pixels || scene_pixels_ > 2 * pixels) {
        SceneOptions options;
        options.pixels = pixels;
        options.threads = threads;
        scene_ = make_scene(recipe, built, supports, options);
        scene_pixels_ = pixels;
    }
    return scene_;
}

std::shared_ptr<const std::string> ServedJob::coverage(int longest, const PassControl& control) const {
    if (longest > coarse_volume)
        return std::make_shared<const std::string>(coverage_volume(*this, longest, control));
    const std::lock_guard lock(volume_mutex_);
    if (!volume_ || volume_longest_ != longest) {
        volume_ = std::make_shared<const std::string>(coverage_volume(*this, longest, control));
        volume_longest_ = longest;
    }
    return volume_;
}

namespace {

/// Rows of the matrix that takes points of the recipe to those of the job; null where a point has several
/// places.
nlohmann::ordered_json axes_of(const ServedJob& served) {
    if (served.parts > 1 || served.built.pieces > 1) return nullptr;
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (int row = 0; row < 3; ++row) rows.push_back(json_triple(glm::row(served.built.axes, row)));
    return rows;
}

}  // namespace

nlohmann::ordered_json ServedJob::facts() const {
    using Json = nlohmann::ordered_json;
    const PrinterProfile& printer = recipe.printer;
    Json heights = Json::array();
    for (const EqualLayers& run : job().layers.runs()) heights.push_back({run.count, run.height});
    Json notes = job().notes;
    if (built.mesh)
        for (const std::string& note : built.mesh->notes) notes.push_back(note);
    for (const std::string& warning : built.regions.warnings) notes.push_back(warning);
    if (plates > 1)
        notes.push_back(
            fmt::format("the parts need {} plates; this is number {}", plates, recipe.plate.number));
    Json display = nullptr;
    if (find_backend(printer.backend).content == LayerContent::pixels) {
        display = {{"width", printer.image.width},
                   {"height", printer.image.height},
                   {"pixel_x", printer.image.pixel_x},
                   {"pixel_y", printer.image.pixel_y}};
    }
    return {{"job", id},
            {"identity", job().identity},
            {"name", job().name},
            {"machine", printer.name},
            {"backend", printer.backend},
            {"process", process_name(process_of(printer))},
            {"bounds", {{"lo", json_triple(job().bounds.lo)}, {"hi", json_triple(job().bounds.hi)}}},
            {"layers",
             {{"count", job().layers.count()}, {"heights", heights}, {"height_mm", job().layers.total()}}},
            {"z0", job().z0()},
            {"axes", axes_of(*this)},
            {"supports", job().supports != nullptr},
            {"parts", parts},
            {"modulus", built.modulus ? modulus_json(*built.modulus) : Json(nullptr)},
            {"structure", structure_parts(*this)},
            {"numbers", varying_numbers(*this)},
            {"notes", notes},
            {"display", display}};
}

}  // namespace lamella
