// Runs surveys, builds supports and arranges plates before the first layer.
#include "app/commands/prepare_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/console/progress.h"
#include "app/reports/grading_report.h"
#include "app/reports/island_report.h"
#include "app/reports/job_report.h"
#include "printers/registry.h"
#include "procedural/elements/element_optimizer.h"
#include "recipe/build/repair_job.h"
#include "recipe/layer_range.h"
#include "recipe/layering/plan_layers.h"
#include "recipe/output/job_picture.h"
#include "recipe/output/plated_job.h"
#include "recipe/printer_choice.h"
#include "recipe/read_recipe.h"
#include "recipe/structure/structure_report.h"

namespace lamella {

namespace {

std::string shell_quoted(const std::string& argument) {
    const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+./:,@%";
    if (!argument.empty() && argument.find_first_not_of(plain) == std::string::npos) return argument;
    std::string text = "'";
    for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

/// Reads the recipes of the other inputs on the plate, with the first one's machine, layer height and
/// supports.
std::vector<Recipe> read_beside(const JobOptions& options, const Recipe& first) {
    std::vector<Recipe> recipes;
    for (const std::string& input : options.beside) {
        Recipe recipe = read_recipe(input, options.recipe.profiles());
        recipe.printer = first.printer;
        recipe.layers = first.layers;
        recipe.support = first.support;
        recipes.push_back(std::move(recipe));
    }
    return recipes;
}

void announce_pattern(OptimizeOptions& options) {
    options.on_pattern = [kept = !options.plans.empty()] {
        std::fputs(kept ? "computing the pattern of the skin, which is kept for later runs\n"
                        : "computing the pattern of the skin\n",
                   stderr);
    };
}

void announce_elements(OptimizeOptions& options) {
    options.on_elements = [kept = !options.plans.empty()](const ElementIteration& iteration,
                                                          int /*iterations*/) {
        if (iteration.index > 0) return;
        std::fputs(kept ? "placing elements, which are kept for later runs\n" : "placing elements\n", stderr);
    };
}

OptimizeOptions optimize_options(const JobOptions& options, const CancelToken& cancel) {
    OptimizeOptions optimizing;
    optimizing.plans = options.plans;
    optimizing.threads = options.threads;
    optimizing.cancel = &cancel;
    if (options.quiet) return optimizing;
    const auto display = std::make_shared<ProgressDisplay>(false, "optimising: ");
    optimizing.on_iteration = [display](const OptimizationStep& iteration, int iterations) {
        display->show(static_cast<double>(iteration.index) / iterations);
    };
    optimizing.on_elements = [shown = std::make_shared<ProgressDisplay>(false, "placing elements: ")](
                                 const ElementIteration& iteration, int iterations) {
        shown->show(static_cast<double>(iteration.index) / iterations);
    };
    announce_pattern(optimizing);
    return optimizing;
}

/// Replaces the job by one with all parts and their copies.
void fill_plate(const Recipe& recipe, BuiltJob& built, const std::vector<Recipe>& others,
                const JobOptions& options, const CancelToken& cancel) {
    std::vector<PlateItem> items{{built.job, recipe.plate.copies}};
    const auto add = [&](const Recipe& other) {
        BuiltJob beside = build_job(other, optimize_options(options, cancel));
        stop_if_cancelled(&cancel);
        finish_with_progress(other, beside, options, cancel);
        items.push_back({beside.job, other.plate.copies});
        return beside.pieces;
    };
    for (const Recipe& piece : other_pieces(recipe, built.pieces)) add(piece);
    for (const Recipe& other : others) {
        for (const Recipe& piece : other_pieces(other, add(first_piece(other)))) add(piece);
    }
    PlatedJob plated = put_on_plates(recipe, items, {options.threads, {}, &cancel});
    built.job = std::move(plated.job);
    if (plated.plates > 1 && !options.quiet) {
        std::fputs(fmt::format("the parts need {} plates; this is number {}, and --plate N makes another\n",
                               plated.plates, recipe.plate.number)
                       .c_str(),
                   stderr);
    }
}

}  // namespace

OptimizeOptions with_kept_plans(bool quiet) {
    OptimizeOptions options;
    options.plans = default_plan_folder();
    if (quiet) return options;
    announce_pattern(options);
    announce_elements(options);
    return options;
}

SupportStructures finish_with_progress(const Recipe& recipe, BuiltJob& built, const JobOptions& options,
                                       const CancelToken& cancel) {
    std::optional<ProgressDisplay> display;
    std::string shown;
    const auto show = [&](const std::string& what, const Progress& progress) {
        if (what != shown) display.emplace(options.quiet, "survey for " + what + ": ");
        shown = what;
        display->show(progress);
    };
    SupportStructures around = finish_job(recipe, built, {options.plans, options.threads, show, &cancel});
    display.reset();
    if (options.quiet) return around;
    if (built.islands && recipe.foam && recipe.foam->drop_islands)
        std::fputs(("islands: " + islands_text(*built.islands) + "\n").c_str(), stderr);
    if (built.repairs) std::fputs(("repairs:\n" + repairs_text(*built.repairs)).c_str(), stderr);
    if (around.supports) std::fputs(("supports: " + supports_text(*around.supports)).c_str(), stderr);
    if (around.shield) std::fputs(("shield: " + shield_text(*around.shield) + "\n").c_str(), stderr);
    return around;
}

std::string resuming(const std::vector<std::string>& arguments) {
    std::string line = "lamella";
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        if (arguments[i] != "--resume" && arguments[i] != "--force") line += " " + shell_quoted(arguments[i]);
    }
    return line + " --resume";
}

PreparedJob prepare_job(const JobOptions& options, const Recipe& given, const CancelToken& cancel) {
    const Recipe recipe = first_piece(given);
    BuiltJob built = build_job(recipe, optimize_options(options, cancel));
    stop_if_cancelled(&cancel);  // before the design was good enough
    if (!options.quiet) note_unused(options.recipe, recipe);
    if (built.mesh && !options.quiet) {
        for (const std::string& note : built.mesh->notes) {
            std::fputs((built.mesh->path + ": " + note + "\n").c_str(), stderr);
        }
    }
    if (!options.quiet) {
        for (const GradingReport& graded : grading_reports(built)) {
            for (const std::string& line : warnings(graded)) std::fputs((line + "\n").c_str(), stderr);
        }
    }
    if (!options.quiet) {
        for (const std::string& line : built.job.notes) std::fputs((line + "\n").c_str(), stderr);
    }
    if (!options.quiet) {
        for (const std::string& line : built.regions.warnings) std::fputs((line + "\n").c_str(), stderr);
    }
    if (built.drains && !options.quiet)
        std::fputs(("drains: " + drains_text(*built.drains) + "\n").c_str(), stderr);
    if (built.cavities && !options.quiet)
        std::fputs(("cavities: " + cavities_text(*built.cavities) + "\n").c_str(), stderr);
    if (built.dowels && !options.quiet)
        std::fputs(("dowels: " + dowels_text(*built.dowels) + "\n").c_str(), stderr);
    std::vector<Recipe> others = read_beside(options, recipe);
    if (!recipe.printer.tools.empty() && !makes_beads(recipe.printer) && !options.quiet)
        std::fputs(fmt::format("[[tool]]: {} has none, and makes the whole part of one material\n",
                               recipe.printer.name)
                       .c_str(),
                   stderr);
    // Surveys take time: report mistakes before them.
    check_layer_heights(recipe.printer, built.job.layers.raised(lift_layers(recipe)));
    if (!recipe.plate.one_by_one)
        parse_layers(options.layers, built.job.layers.count() + lift_layers(recipe).count());
    const SupportStructures around = finish_with_progress(recipe, built, options, cancel);
    add_picture(recipe, built, around.supports, options.threads);
    fill_plate(given, built, others, options, cancel);
    StreamOptions stream;
    stream.range = parse_layers(options.layers, built.job.layers.count());
    stream.threads = options.threads;
    stream.look_ahead = options.look_ahead;
    stream.resume = options.resume;
    stream.cancel = &cancel;
    return {std::move(built), stream};
}

void add_job_options(CLI::App& command, JobOptions& options) {
    command
        .add_option("--layers", options.layers,
                    "Layers A up to, not including, B, counted from 0; default: all")
        ->type_name("A:B");
    command
        .add_option("--beside", options.beside,
                    "Another recipe or model on the same plate, with the machine, layer height and supports "
                    "of the first; may be repeated")
        ->type_name("FILE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        .add_option("--look-ahead", options.look_ahead,
                    "Maximum number of layers in flight; 0: two per thread")
        ->check(CLI::Range(0, 4096));
    add_survey_options(command, options);
}

void add_survey_options(CLI::App& command, JobOptions& options) {
    command.add_option("--threads", options.threads, "Threads to use; 0: one per core")
        ->check(CLI::Range(0, 1024));
    command
        .add_option("--plans", options.plans,
                    "Folder in which supports and optimised parts are kept for later runs of the same job, "
                    "\"\" for none; "
                    "default: lamella/plans in the user's cache")
        ->type_name("DIR");
}

}  // namespace lamella
