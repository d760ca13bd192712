// `lamella slice`: streams the layers of a recipe or a model to a printer's back-end.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands/commands.h"
#include "app/commands/prepare_job.h"
#include "app/console/interrupt.h"
#include "app/console/progress.h"
#include "app/console/text_output.h"
#include "app/ranks/distribute_layers.h"
#include "app/ranks/run_on_ranks.h"
#include "app/reports/check_outputs.h"
#include "app/reports/empty_job.h"
#include "app/reports/island_report.h"
#include "app/reports/job_report.h"
#include "bindings/plugin.h"
#include "engine/base/error.h"
#include "engine/layers/layer_stream.h"
#include "printers/archive/shard_file.h"
#include "printers/archive/unfinished_folder.h"
#include "printers/registry.h"
#include "recipe/base_material.h"
#include "recipe/build/repair_job.h"
#include "recipe/output/beam_output.h"
#include "recipe/output/outputs.h"
#include "recipe/output/render_only.h"

namespace lamella {

namespace {

struct SliceOptions : JobOptions {
    std::vector<std::string> output;
    std::vector<std::string> plugins;
    std::string shard;
    bool force = false;
    bool json = false;
    bool check = false;
    std::string repeat;  ///< the command line that continues this run
};

std::int64_t peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

/// The results of a run that its summary reports.
struct Written {
    std::optional<BeamLatticeReport> beams;
    std::vector<std::string> notes;
    std::vector<CheckOutcome> checks;  ///< one for each output; empty when none was requested
};

/// Returns the mass of a part's volume (mm^3), g; 0 when the material's density is unknown.
double mass_of(const Recipe& recipe, double volume) {
    constexpr double mm3_per_cm3 = 1000;
    return recipe.material ? base_material(*recipe.material).density * volume / mm3_per_cm3 : 0;
}

void summarise(const SliceOptions& options, const std::vector<Output>& outputs, const BuiltJob& built,
               const StreamReport& report, const ProgressDisplay& display, const Written& written,
               const Recipe& recipe) {
    const std::optional<BeamLatticeReport>& beams = written.beams;
    const double seconds = display.seconds();
    if (options.json) {
        nlohmann::ordered_json summary{
            {"output", options.shard.empty() ? outputs.front().path : options.shard},
            {"identity", built.job.identity},
            {"layers", report.layers_written},
            {"layers_kept", report.layers_kept},
            {"seconds", seconds},
            {"first_layer_seconds", display.first_layer_seconds()},
            {"peak_memory_bytes", peak_memory_bytes()},
            {"volume_mm3", report.volume}};
        for (std::size_t i = 1; i < outputs.size(); ++i) summary["more_outputs"].push_back(outputs[i].path);
        if (const double mass = mass_of(recipe, report.volume); mass > 0) summary["mass_g"] = mass;
        if (!built.job.notes.empty()) summary["job_notes"] = built.job.notes;
        if (built.job.supports) summary["support_volume_mm3"] = report.support_volume;
        if (built.drains) summary["drains"] = drains_json(*built.drains);
        if (built.cavities) summary["cavities"] = cavities_json(*built.cavities);
        if (built.dowels) summary["dowels"] = dowels_json(*built.dowels);
        if (built.islands) summary["islands"] = islands_json(*built.islands);
        if (built.repairs) summary["repairs"] = repairs_json(*built.repairs);
        if (beams) {
            summary["beams"] = {{"output", recipe.output.beams},
                                {"beams", beams->beams},
                                {"nodes", beams->vertices},
                                {"too_short", beams->dropped}};
        }
        if (!written.notes.empty()) summary["notes"] = written.notes;
        for (const CheckOutcome& checked : written.checks)
            summary["checks"].push_back(check_json(checked, built.job));
        TextOutput out("");
        out.write(summary.dump(2) + "\n");
        out.close();
    }
    if (options.quiet) return;
    for (const std::string& note : written.notes) std::fputs(("note: " + note + "\n").c_str(), stderr);
    const std::string kept = report.layers_kept > 0 ? fmt::format(" ({} kept)", report.layers_kept) : "";
    const std::string supports =
        built.job.supports ? fmt::format(" and {:.1f} mm3 of supports", report.support_volume) : "";
    const double grams = mass_of(recipe, report.volume);
    const std::string mass = grams > 0 ? fmt::format(", {:.3g} g", grams) : "";
    std::string paths;
    if (!options.shard.empty()) paths = options.shard;
    for (const Output& output : options.shard.empty() ? outputs : std::vector<Output>())
        paths += (paths.empty() ? "" : ", ") + (output.path == "-" ? "standard output" : output.path);
    std::fputs(fmt::format("{}: {} layers{} in {:.2f} s, {:.1f} mm3 of material{}{}, {} MiB at most\n", paths,
                           report.layers_written, kept, seconds, report.volume, mass, supports,
                           peak_memory_bytes() >> 20)
                   .c_str(),
               stderr);
    for (const Output& output : outputs) {
        if (output.open) continue;
        if (const char* warning = find_backend(output.printer.backend).warning)
            std::fputs(fmt::format("{}: {}\n", output.path, warning).c_str(), stderr);
    }
    if (beams) std::fputs((lattice_text(recipe.output.beams, *beams) + "\n").c_str(), stderr);
    for (const CheckOutcome& checked : written.checks)
        std::fputs(("\n" + check_text(checked)).c_str(), stderr);
}

/// Returns the failures of the checks; empty for none. The user decides what to do about them.
std::string failures_text(const std::vector<CheckOutcome>& checks) {
    std::string text;
    for (const CheckOutcome& checked : checks) {
        if (!checked.report.passed()) text += failure_text(checked) + "\n";
    }
    return text.empty() ? text : text + "all layers have been written nevertheless";
}

std::vector<Output> outputs_of(const SliceOptions& options, const Recipe& recipe) {
    std::vector<OutsideBackend> plugins;
    plugins.reserve(options.plugins.size());
    for (const std::string& path : options.plugins) plugins.push_back(load_plugin(path));
    std::vector<Output> outputs = read_outputs(options.output, recipe, options.recipe.profiles(), plugins);
    const auto is_outside = [](const Output& output) { return static_cast<bool>(output.open); };
    if (!plugins.empty() && std::ranges::none_of(outputs, is_outside)) {
        throw InputError(fmt::format(
            "--plugin {}: no output uses this plugin; accepted: -o PATH@{}{}", options.plugins.front(),
            plugins.front().name,
            plugins.front().ending.empty() ? "" : ", or a path that ends in " + plugins.front().ending));
    }
    return outputs;
}

/// Takes the outputs that are complete out of a resumed run's, and says so: a run repeated until it succeeds
/// ends well. Returns false when none is left.
bool leave_complete(const SliceOptions& options, std::vector<Output>& outputs) {
    if (!options.resume || options.force || !options.shard.empty()) return true;
    std::erase_if(outputs, [&](const Output& output) {
        const bool complete = is_finished_output(output.path);
        if (complete && !options.quiet)
            std::fputs((output.path + ": complete already; --force makes it anew\n").c_str(), stderr);
        return complete;
    });
    return !outputs.empty();
}

/// Throws InputError for options that conflict with layers on standard output.
void check_standard_output(const SliceOptions& options) {
    if (options.json) {
        throw InputError(
            "--json: conflicts with -o -, because the summary and the layers would both go to standard "
            "output; accepted: -o FILE, or no --json");
    }
    if (options.resume) throw InputError("--resume: standard output cannot be continued; accepted: -o FILE");
}

/// Throws InputError for options that shards or several processes do not support.
void check_sharing(const SliceOptions& options, const Ranks* ranks) {
    if (!options.shard.empty() && options.check)
        throw InputError(
            "--check: needs all layers, and --shard has only some; accepted: --check or --shard, not both");
    if (ranks == nullptr) return;
    if (!options.shard.empty())
        throw InputError(
            "--shard: under mpirun the processes' layers are joined already; accepted: mpirun or --shard, "
            "not both");
    if (!options.plugins.empty())
        throw InputError(
            "--plugin: layers rendered by a plugin cannot be sent to another process; accepted: one process, "
            "or lamella's own printers");
}

/// Makes the back-end of the outputs, or of a shard for them.
std::unique_ptr<Backend> layers_to(const SliceOptions& options, const std::vector<Output>& outputs,
                                   const Job& job) {
    if (options.shard.empty()) return make_outputs(outputs, options.force);
    return make_shard_writer(make_renderer(outputs, {0, job.layers.count()}), options.shard,
                             settings_of(outputs), options.force);
}

/// Adds the requested checks to the outputs.
std::unique_ptr<Backend> with_checks(std::unique_ptr<Backend> to, OutputChecks& checking,
                                     const SliceOptions& options, const Recipe& recipe,
                                     const std::vector<Output>& outputs, const Job& job) {
    if (!options.check) return to;
    const int parts = std::max(1, static_cast<int>(job.objects.size()));
    return checking.beside(std::move(to), outputs, recipe.part.name, job, parts);
}

/// Slices; `ranks`: the processes that share the layers, null for a single process.
std::string run(const SliceOptions& options, Ranks* ranks) {
    check_sharing(options, ranks);
    const bool to_pipe = std::find(options.output.begin(), options.output.end(), "-") != options.output.end();
    if (to_pipe) check_standard_output(options);
    ProgressDisplay display(options.quiet);
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const Recipe recipe = options.recipe.read();
    std::vector<Output> outputs = outputs_of(options, recipe);
    if (!leave_complete(options, outputs)) return "";
    if (options.check && !options.layers.empty()) {
        throw InputError(
            "--check: needs all layers, and --layers leaves some out; accepted: --check or --layers, not "
            "both");
    }
    const PreparedJob prepared = prepare_job(options, recipe, cancel);
    const BuiltJob& built = prepared.built;
    StreamOptions stream = prepared.stream;
    // Of several runs over ranges of layers, only the first writes the beams.
    const bool with_beams = !recipe.output.beams.empty() && stream.range.first == 0;
    if (with_beams) check_beam_output(recipe, built, options.force || options.resume);
    stream.on_progress = [&](const Progress& progress) { display.show(progress); };
    StreamReport report;
    std::vector<std::string> notes;
    std::vector<CheckOutcome> checks;
    try {
        OutputChecks checking;
        auto backend = with_checks(layers_to(options, outputs, built.job), checking, options, recipe, outputs,
                                   built.job);
        report = ranks ? spread_layers(*ranks, built.job, backend, stream)
                       : stream_layers(built.job, *backend, stream);
        notes = backend->notes();
        checks = checking.outcomes();
    } catch (const Interrupted&) {
        display.finish();
        if (to_pipe) throw Interrupted("interrupted; standard output holds a part of the layers");
        throw Interrupted("interrupted; what is finished is kept. To go on: " + options.repeat);
    }
    display.finish();
    std::optional<BeamLatticeReport> beams;
    if (with_beams) beams = write_beam_output(recipe, built);
    summarise(options, outputs, built, report, display, {beams, notes, checks}, recipe);
    // Printers from outside may leave areas out.
    const bool has_outside = std::ranges::any_of(outputs, [](const Output& o) { return bool(o.open); });
    const std::string empty = has_outside ? "" : empty_job_text(recipe, built.job, report);
    return empty.empty() ? failures_text(checks) : empty;
}

/// The work of ranks other than 0. Rank 0 finds the same mistakes and reports them.
void run_worker(const SliceOptions& given, Ranks& ranks) {
    SliceOptions options = given;
    options.quiet = true;
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const Recipe recipe = options.recipe.read();
    std::vector<Output> outputs = outputs_of(options, recipe);
    if (!leave_complete(options, outputs)) return;
    const PreparedJob prepared = prepare_job(options, recipe, cancel);
    const Job& job = prepared.built.job;
    OutputChecks checking;
    auto renderer =
        with_checks(make_renderer(outputs, prepared.stream.range), checking, options, recipe, outputs, job);
    render_blocks(ranks, job, std::move(renderer), prepared.stream);
}

}  // namespace

void add_slice_command(CLI::App& root, const std::vector<std::string>& arguments) {
    auto options = std::make_shared<SliceOptions>();
    options->repeat = resuming(arguments);
    CLI::App& command = *root.add_subcommand("slice", "Turn a recipe or a model into printable layers");
    options->recipe.add_to(command);
    command
        .add_option("-o,--output", options->output,
                    "File or folder to make, \"-\" for standard output; default: the part's name. Repeat -o "
                    "to write several in one run; the ending selects the format, @PROFILE another machine")
        ->type_name("PATH[@PROFILE]")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        .add_option("--plugin", options->plugins,
                    "Shared library with an additional printer, used by outputs with its file ending or with "
                    "@ and its name; may be repeated")
        ->type_name("FILE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        .add_option("--shard", options->shard,
                    "Pack the layers of --layers into this file, from which `lamella join` makes the outputs")
        ->type_name("FILE");
    add_job_options(command, *options);
    command.add_flag("--resume", options->resume, "Continue an unfinished output of the same job");
    command.add_flag("--force", options->force, "Replace an existing output");
    command.add_flag("--check", options->check,
                     "Also check whether the part can be printed, like `lamella check`; all layers are "
                     "written, and the exit code is 1 if it cannot");
    command.add_flag("-q,--quiet", options->quiet, "No progress on standard error");
    command.add_flag("--json", options->json, "Write a summary of the run as JSON to standard output");
    finish_command(
        command,
        "  lamella slice insole.toml -o insole/\n"
        "  lamella slice model.stl --cell 3 --beam 0.5 --skin 0.8 --layer-height 0.05 --printer png -o out/\n"
        "  lamella slice --shape sphere --shape-radius 10 --printer svg -o sphere.svg\n"
        "  lamella slice insole.toml -o insole.sl1@prusa-sl1s -o insole.gcode@marlin\n"
        "  lamella slice insole.toml --layers 100:200 --json\n"
        "  lamella slice insole.toml --check -o insole.sl1\n"
        "  lamella slice insole.toml --printer ember -o - | ssh printer 'cat > insole.tar.gz'\n"
        "  lamella slice insole.toml -o insole.sl1 --layers 0:400 --shard first.shard\n"
        "  mpirun -n 4 lamella slice insole.toml -o insole.sl1\n"
        "Ctrl-C stops cleanly; the same command with --resume goes on.");
    command.callback([options] {
        run_on_ranks([&](Ranks* ranks) { return run(*options, ranks); },
                     [&](Ranks& ranks) { run_worker(*options, ranks); });
    });
}

}  // namespace lamella
