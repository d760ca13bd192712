// `lamella optimize` and `lamella analyze`: the shape that bears the loads, and how a part bears them.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "app/charts/structure_plot.h"
#include "app/commands/commands.h"
#include "app/commands/prepare_job.h"
#include "app/console/interrupt.h"
#include "app/console/text_output.h"
#include "app/ranks/distribute_cases.h"
#include "app/ranks/run_on_ranks.h"
#include "app/reports/structure_text.h"
#include "engine/base/error.h"
#include "procedural/volume/density_bricks.h"
#include "procedural/volume/write_nrrd.h"
#include "recipe/structure/analyse_part.h"

namespace lamella {

namespace {

struct StructureCommand : JobOptions {
    std::string output;
    std::string save, plot;
    std::string model = "auto";
    int elements = 0;
    bool resume = false;
    bool json = false;
};

/// One line that is overwritten on a terminal; every tenth iteration otherwise.
class IterationDisplay {
  public:
    explicit IterationDisplay(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}
    ~IterationDisplay() {
        if (open_) std::fputc('\n', stderr);
    }
    IterationDisplay(const IterationDisplay&) = delete;
    IterationDisplay& operator=(const IterationDisplay&) = delete;

    void show(const OptimizationStep& step, int steps) {
        constexpr int shown_every = 10;
        if (quiet_ || (!terminal_ && step.index % shown_every != 0)) return;
        const std::string text = step_text(step, steps);
        std::fputs((terminal_ ? "\r\033[K" + text : text + "\n").c_str(), stderr);
        open_ = terminal_;
    }

  private:
    bool quiet_, terminal_, open_ = false;
};

void write_report(const StructureCommand& command, const StructureReport& report) {
    TextOutput out(command.output);
    out.write(command.json ? structure_json(report).dump(2) + "\n" : structure_text(report));
    out.close();
}

void save_densities(const OptimizedPart& part, const std::string& path) {
    const DensityBricks& densities = *part.densities;
    write_nrrd(path, densities.size(), densities.dense(), densities.box());
}

void draw(const StructureCommand& command, const Recipe& recipe, const OptimizedPart& part) {
    const bool is_foam = drives_foam(recipe.optimize->result);
    TextOutput out(command.plot);
    out.write(structure_svg(recipe.part.name, part, is_foam));
    out.close();
}

Recipe optimized_recipe(const StructureCommand& command) {
    Recipe recipe = command.recipe.read();
    check_is_optimized(recipe);
    return recipe;
}

/// Returns the number of load cases; self-weight alone is one.
std::size_t case_count(const Recipe& recipe) {
    std::set<std::string> names;
    for (const LoadRecipe& load : recipe.loads) names.insert(load.load_case);
    return std::max<std::size_t>(names.size(), 1);
}

OptimizeOptions optimize_options(const StructureCommand& command, const CancelToken& cancel,
                                 SharedSolves* shared) {
    OptimizeOptions options;
    options.plans = command.plans;
    options.anew = true;
    options.resume = command.resume;
    options.threads = command.threads;
    options.cancel = &cancel;
    options.shared = shared;
    return options;
}

/// `ranks`: the processes that share the load cases; null for a single process.
void optimize(const StructureCommand& command, Ranks* ranks) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const Recipe recipe = optimized_recipe(command);
    std::optional<DistributedCases> cases;
    if (ranks != nullptr) cases.emplace(*ranks, case_count(recipe), &cancel);
    OptimizeOptions options = optimize_options(command, cancel, cases ? &*cases : nullptr);
    IterationDisplay display(command.quiet);
    options.on_iteration = [&](const OptimizationStep& step, int steps) { display.show(step, steps); };
    const BuiltJob built = build_job(recipe, options);
    if (!command.save.empty()) save_densities(*built.optimized, command.save);
    if (!command.plot.empty()) draw(command, recipe, *built.optimized);
    write_report(command, *built.optimized->report);
    if (cancel.cancelled()) throw Interrupted("stopped; the report is that of the best design so far");
}

/// The work of ranks other than 0: the same search, without a report.
void help_to_optimize(const StructureCommand& command, Ranks& ranks) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const Recipe recipe = optimized_recipe(command);
    DistributedCases cases(ranks, case_count(recipe), &cancel);
    if (cases.is_needed()) build_job(recipe, optimize_options(command, cancel, &cases));
}

int analyze(const StructureCommand& command) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const Recipe recipe = command.recipe.read();
    OptimizeOptions optimizing;
    optimizing.plans = command.plans;
    optimizing.threads = command.threads;
    optimizing.cancel = &cancel;
    optimizing.as_designed = true;  // loads and anchors are those of the part before it is turned
    const BuiltJob built = build_job(recipe, optimizing);
    AnalysisOptions options;
    options.model = command.model == "law"        ? AnalysisModel::law
                    : command.model == "elements" ? AnalysisModel::elements
                                                  : AnalysisModel::automatic;
    options.elements = command.elements;
    options.threads = command.threads;
    options.cancel = &cancel;
    write_report(command, analyse_part(recipe, built, options));
    return 0;
}

void add_options(CLI::App& command, StructureCommand& options) {
    options.recipe.add_to(command);
    add_survey_options(command, options);
    command.add_option("-o,--output", options.output, "File for the report; default: standard output")
        ->type_name("FILE");
    command.add_flag("--json", options.json, "Write the report as JSON");
    command.add_flag("-q,--quiet", options.quiet, "Nothing on standard error but errors");
}

}  // namespace

void add_optimize_command(CLI::App& root) {
    auto options = std::make_shared<StructureCommand>();
    CLI::App& command = *root.add_subcommand(
        "optimize",
        "Find the stiffest or lightest shape or foam of a part under its loads, or a plate like a picture");
    add_options(command, *options);
    command
        .add_option("--save", options->save,
                    "Write the densities as a volume (NRRD): above 0.5 is solid; of a foam, its solid share")
        ->type_name("FILE");
    command
        .add_option("--plot", options->plot,
                    "Picture (SVG) of the steps, and of the result with its loads and supports")
        ->type_name("FILE");
    command.add_flag("--resume", options->resume, "Go on where Ctrl-C ended the search");
    finish_command(
        command,
        "  lamella optimize bracket.toml --plot bracket.svg\n"
        "  lamella optimize bracket.toml --optimize-elements 96 --json -o report.json\n"
        "  lamella slice bracket.toml -o bracket.sl1\n"
        "  mpirun -n 3 lamella optimize bracket.toml\n"
        "The result is kept with the plans, where slice and all other commands find it. Ctrl-C ends the\n"
        "search and reports the best design so far; --resume goes on with it. mpirun distributes load "
        "cases:\n"
        "a recipe with a single one uses one process.");
    command.callback([options] {
        const auto lead = [&](Ranks* ranks) { return optimize(*options, ranks), std::string(); };
        run_on_ranks(lead, [&](Ranks& ranks) { help_to_optimize(*options, ranks); });
    });
}

void add_analyze_command(CLI::App& root) {
    auto options = std::make_shared<StructureCommand>();
    CLI::App& command = *root.add_subcommand("analyze", "Compute how a part bends under its loads");
    add_options(command, *options);
    command
        .add_option(
            "--model", options->model,
            "What stands for the part: elements inside it, the law of its foam, or auto: the law if it is "
            "known")
        ->check(CLI::IsMember({"auto", "elements", "law"}));
    command
        .add_option(
            "--elements", options->elements,
            "Elements along the longest side of the part; default: those of [optimize], else 64, in the "
            "plane 200")
        ->type_name("N")
        ->check(CLI::Range(8, 2048));
    finish_command(
        command,
        "  lamella analyze bracket.toml\n"
        "  lamella analyze foam.toml --model law\n"
        "  lamella analyze foam.toml --model elements --elements 256\n"
        "Elements are cubes: struts need four or more across, and peaks of stress at steps are guesses.");
    command.callback([options] { analyze(*options); });
}

}  // namespace lamella
