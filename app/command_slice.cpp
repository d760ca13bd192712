// `lamella slice`: streams the layers of a recipe or a model to a printer's back-end.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/beam_output.h"
#include "app/build_job.h"
#include "app/build_supports.h"
#include "app/commands.h"
#include "app/grading_report.h"
#include "app/interrupt.h"
#include "app/island_report.h"
#include "app/job_picture.h"
#include "app/layer_range.h"
#include "app/outputs.h"
#include "app/printer_choice.h"
#include "app/progress.h"
#include "app/recipe_options.h"
#include "app/text_output.h"
#include "engine/error.h"
#include "engine/layer_stream.h"
#include "engine/plate.h"
#include "printers/registry.h"

namespace lamella {

namespace {

struct SliceOptions {
    RecipeOptions recipe;
    std::vector<std::string> output;
    std::string layers;
    std::string plans = default_plan_folder();
    std::vector<std::string> beside;
    int threads = 0;
    int look_ahead = 0;
    bool resume = false;
    bool force = false;
    bool quiet = false;
    bool json = false;
    std::string repeat;  ///< the command line that continues this run
};

std::string quoted(const std::string& argument) {
    const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+./:,@%";
    if (!argument.empty() && argument.find_first_not_of(plain) == std::string::npos) return argument;
    std::string text = "'";
    for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

std::string resuming(const std::vector<std::string>& arguments) {
    std::string line = "lamella";
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        if (arguments[i] != "--resume" && arguments[i] != "--force") line += " " + quoted(arguments[i]);
    }
    return line + " --resume";
}

std::int64_t peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

/// What a run made and what is to be said of it.
struct Written {
    std::optional<BeamLatticeReport> beams;
    std::vector<std::string> notes;
};

void summarise(const SliceOptions& options, const std::vector<Output>& outputs, const BuiltJob& built,
               const StreamReport& report, const ProgressDisplay& display, const Written& written,
               const Recipe& recipe) {
    const std::optional<BeamLatticeReport>& beams = written.beams;
    const double seconds = display.seconds();
    if (options.json) {
        nlohmann::ordered_json summary{{"output", outputs.front().path},
                                       {"identity", built.job.identity},
                                       {"layers", report.layers_written},
                                       {"layers_kept", report.layers_kept},
                                       {"seconds", seconds},
                                       {"first_layer_seconds", display.first_layer_seconds()},
                                       {"peak_memory_bytes", peak_memory_bytes()},
                                       {"volume_mm3", report.volume}};
        for (std::size_t i = 1; i < outputs.size(); ++i) summary["more_outputs"].push_back(outputs[i].path);
        if (built.job.supports) summary["support_volume_mm3"] = report.support_volume;
        if (built.drains) summary["drains"] = drains_json(*built.drains);
        if (built.dowels) summary["dowels"] = dowels_json(*built.dowels);
        if (built.islands) summary["islands"] = islands_json(*built.islands);
        if (beams) {
            summary["beams"] = {{"output", recipe.output.beams},
                                {"beams", beams->beams},
                                {"nodes", beams->vertices},
                                {"too_short", beams->dropped}};
        }
        if (!written.notes.empty()) summary["notes"] = written.notes;
        TextOutput out("");
        out.write(summary.dump(2) + "\n");
        out.close();
    }
    if (options.quiet) return;
    for (const std::string& note : written.notes) std::fputs(("note: " + note + "\n").c_str(), stderr);
    const std::string kept = report.layers_kept > 0 ? fmt::format(" ({} kept)", report.layers_kept) : "";
    const std::string supports =
        built.job.supports ? fmt::format(" and {:.1f} mm3 of supports", report.support_volume) : "";
    std::string paths;
    for (const Output& output : outputs)
        paths += (paths.empty() ? "" : ", ") + (output.path == "-" ? "standard output" : output.path);
    std::fputs(
        fmt::format("{}: {} layers{} in {:.2f} s, {:.1f} mm3 of material{}, {} MiB at most\n", paths,
                    report.layers_written, kept, seconds, report.volume, supports, peak_memory_bytes() >> 20)
            .c_str(),
        stderr);
    for (const Output& output : outputs) {
        if (const char* warning = find_backend(output.printer.backend).warning)
            std::fputs(fmt::format("{}: {}\n", output.path, warning).c_str(), stderr);
    }
    if (beams) std::fputs((lattice_text(recipe.output.beams, *beams) + "\n").c_str(), stderr);
}

void survey(const Recipe& recipe, BuiltJob& built, const SliceOptions& options, const CancelToken& cancel) {
    ProgressDisplay display(options.quiet, "survey for islands: ");
    IslandSurveyOptions survey;
    survey.threads = options.threads;
    survey.cancel = &cancel;
    survey.on_progress = [&](const Progress& progress) { display.show(progress); };
    drop_islands(recipe, built, survey);
    display.finish();
    if (!options.quiet) std::fputs(("islands: " + islands_text(*built.islands) + "\n").c_str(), stderr);
}

/// The recipes of what stands beside the part, with its machine, layers and supports.
std::vector<Recipe> read_beside(const SliceOptions& options, const Recipe& first) {
    std::vector<Recipe> recipes;
    for (const std::string& input : options.beside) {
        Recipe recipe = read_recipe(input, options.recipe.profiles());
        recipe.printer = first.printer;
        recipe.layer_height = first.layer_height;
        recipe.support = first.support;
        recipes.push_back(std::move(recipe));
    }
    return recipes;
}

/// Makes the job one of all parts and their copies.
void fill_plate(const Recipe& recipe, BuiltJob& built, const std::vector<Recipe>& others,
                const SliceOptions& options, const CancelToken& cancel) {
    std::vector<PlateItem> items{{built.job, recipe.plate.copies}};
    for (const Recipe& other : others) {
        BuiltJob beside = build_job(other);
        if (other.foam && other.foam->drop_islands) survey(other, beside, options, cancel);
        add_supports_with_progress(other, beside, {options.plans, options.threads, {}, &cancel},
                                   options.quiet);
        items.push_back({beside.job, other.plate.copies});
    }
    built.job = arrange_plate(items, recipe.plate.gap, plate_size(recipe.printer));
}

/// Standard output takes the layers and nothing else.
void check_standard_output(const SliceOptions& options) {
    if (options.json) {
        throw InputError(
            "--json: its summary goes to standard output, which -o - fills with the layers; name a "
            "file with -o, or leave --json out");
    }
    if (options.resume)
        throw InputError("--resume: standard output cannot be continued; name a file with -o");
}

void run(const SliceOptions& options) {
    const bool to_pipe = std::find(options.output.begin(), options.output.end(), "-") != options.output.end();
    if (to_pipe) check_standard_output(options);
    ProgressDisplay display(options.quiet);
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const Recipe recipe = options.recipe.read();
    const std::vector<Output> outputs = read_outputs(options.output, recipe, options.recipe.profiles());
    BuiltJob built = build_job(recipe);
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
        for (const std::string& line : built.regions.warnings) std::fputs((line + "\n").c_str(), stderr);
    }
    if (built.drains && !options.quiet)
        std::fputs(("drains: " + drains_text(*built.drains) + "\n").c_str(), stderr);
    if (built.dowels && !options.quiet)
        std::fputs(("dowels: " + dowels_text(*built.dowels) + "\n").c_str(), stderr);
    std::vector<Recipe> others = read_beside(options, recipe);
    // Surveys take time: what is wrong should be known before them.
    parse_layers(options.layers, built.job.layer_count + lifted_layers(recipe, built.job));
    if (recipe.foam && recipe.foam->drop_islands) survey(recipe, built, options, cancel);
    const auto supports = add_supports_with_progress(
        recipe, built, {options.plans, options.threads, {}, &cancel}, options.quiet);
    if (supports && !options.quiet) std::fputs(("supports: " + supports_text(*supports)).c_str(), stderr);
    add_picture(recipe, built, supports, options.threads);
    if (recipe.plate.copies > 1 || !others.empty()) fill_plate(recipe, built, others, options, cancel);
    StreamOptions stream;
    stream.range = parse_layers(options.layers, built.job.layer_count);
    // Of several runs for ranges of layers, the first writes the beams.
    const bool with_beams = !recipe.output.beams.empty() && stream.range.first == 0;
    if (with_beams) check_beam_output(recipe, built, options.force || options.resume);
    stream.threads = options.threads;
    stream.look_ahead = options.look_ahead;
    stream.resume = options.resume;
    stream.cancel = &cancel;
    stream.on_progress = [&](const Progress& progress) { display.show(progress); };
    StreamReport report;
    std::vector<std::string> notes;
    try {
        const auto backend = make_outputs(outputs, options.force);
        report = stream_layers(built.job, *backend, stream);
        notes = backend->notes();
    } catch (const Interrupted&) {
        display.finish();
        if (to_pipe) throw Interrupted("interrupted; standard output holds a part of the layers");
        throw Interrupted("interrupted; what is finished is kept. To go on: " + options.repeat);
    }
    display.finish();
    std::optional<BeamLatticeReport> beams;
    if (with_beams) beams = write_beam_output(recipe, built);
    summarise(options, outputs, built, report, display, {beams, notes}, recipe);
}

}  // namespace

void add_slice_command(CLI::App& root, const std::vector<std::string>& arguments) {
    auto options = std::make_shared<SliceOptions>();
    options->repeat = resuming(arguments);
    CLI::App& command = *root.add_subcommand("slice", "Turn a recipe or a model into printable layers");
    options->recipe.add_to(command);
    command
        .add_option("-o,--output", options->output,
                    "File or folder to make, \"-\" for standard output; default: the part's name. Several, "
                    "each with -o, are made in one "
                    "run; the ending chooses the format, @PROFILE another machine")
        ->type_name("PATH[@PROFILE]")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        .add_option("--layers", options->layers,
                    "Layers A up to, not including, B, counted from 0; default: all")
        ->type_name("A:B");
    command
        .add_option(
            "--beside", options->beside,
            "Another recipe or model on the same plate; with several, --beside stands before each. It "
            "is cut and supported as the first one says")
        ->type_name("FILE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("--threads", options->threads, "Threads to use; 0: one a core")
        ->check(CLI::Range(0, 1024));
    command.add_option("--look-ahead", options->look_ahead, "Layers in flight at most; 0: two a thread")
        ->check(CLI::Range(0, 4096));
    command
        .add_option("--plans", options->plans,
                    "Folder where plans of supports are kept for later runs of the same job, \"\" for none; "
                    "default: lamella/plans in the user's cache")
        ->type_name("DIR");
    command.add_flag("--resume", options->resume, "Continue an unfinished output of the same job");
    command.add_flag("--force", options->force, "Replace an output that exists");
    command.add_flag("-q,--quiet", options->quiet, "No progress on standard error");
    command.add_flag("--json", options->json, "A summary of the run on standard output");
    finish_command(
        command,
        "  lamella slice insole.toml -o insole/\n"
        "  lamella slice model.stl --cell 3 --beam 0.5 --skin 0.8 --layer-height 0.05 --printer png -o out/\n"
        "  lamella slice --shape sphere --shape-radius 10 --printer svg -o sphere.svg\n"
        "  lamella slice insole.toml -o insole.sl1@prusa-sl1s -o insole.gcode@marlin\n"
        "  lamella slice insole.toml --layers 100:200 --json\n"
        "  lamella slice insole.toml --printer ember -o - | ssh printer 'cat > insole.tar.gz'\n"
        "Ctrl-C stops cleanly; the same command with --resume goes on.");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
