// `lamella check`: checks a part against the limits of a machine's process.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <optional>

#include "app/commands/commands.h"
#include "app/commands/prepare_job.h"
#include "app/console/interrupt.h"
#include "app/console/progress.h"
#include "app/console/text_output.h"
#include "app/ranks/distribute_layers.h"
#include "app/ranks/run_on_ranks.h"
#include "app/reports/check_outputs.h"
#include "app/reports/check_page.h"

namespace lamella {

namespace {

struct CheckCommand : JobOptions {
    std::string output;
    std::string page;
    bool json = false;
};

/// A recipe with a single part, to which the check applies.
Recipe recipe_of(const CheckCommand& options) {
    Recipe recipe = options.recipe.read();
    recipe.plate.copies = 1;
    recipe.plate.one_by_one = false;  // layers are checked, in whatever order they are printed
    return recipe;
}

int parts_of(const Job& job) { return std::max(1, static_cast<int>(job.objects.size())); }

CheckOutcome check_layers(const CheckCommand& options, const Recipe& recipe, const PreparedJob& prepared,
                          Ranks* ranks) {
    const Job& job = prepared.built.job;
    OutputChecks checking;
    auto check = checking.check_of(recipe.printer, recipe.part.name, job, parts_of(job));
    ProgressDisplay display(options.quiet, "check: ");
    StreamOptions stream = prepared.stream;
    stream.on_progress = [&](const Progress& progress) { display.show(progress); };
    if (ranks != nullptr) {
        spread_layers(*ranks, job, check, stream);
    } else {
        stream_layers(job, *check, stream);
    }
    return checking.outcomes().front();
}

/// Checks the layers; `ranks`: the processes that share them, null for a single process.
std::string run(const CheckCommand& options, Ranks* ranks) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const Recipe recipe = recipe_of(options);
    const PreparedJob prepared = prepare_job(options, recipe, cancel);
    const Job& job = prepared.built.job;
    // Output files are opened first, so that errors appear before the long work.
    if (!options.page.empty() && options.page == options.output)
        throw InputError("--report: " + options.page +
                         " is also the file of --output; accepted: a different file for each");
    TextOutput table(options.output);
    std::optional<TextOutput> page;
    if (!options.page.empty()) page.emplace(options.page);
    const CheckOutcome outcome = check_layers(options, recipe, prepared, ranks);
    table.write(options.json ? check_json(outcome, job).dump(2) + "\n" : check_text(outcome));
    table.close();
    if (page) {
        page->write(check_page(outcome, job));
        page->close();
    }
    return outcome.report.passed() ? "" : failure_text(outcome);
}

/// The work of ranks other than 0.
void run_worker(const CheckCommand& given, Ranks& ranks) {
    CheckCommand options = given;
    options.quiet = true;
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const Recipe recipe = recipe_of(options);
    const PreparedJob prepared = prepare_job(options, recipe, cancel);
    OutputChecks checking;
    render_blocks(
        ranks, prepared.built.job,
        checking.check_of(recipe.printer, recipe.part.name, prepared.built.job, parts_of(prepared.built.job)),
        prepared.stream);
}

}  // namespace

void add_check_command(CLI::App& root) {
    auto options = std::make_shared<CheckCommand>();
    CLI::App& command = *root.add_subcommand(
        "check",
        "Check whether a part can be printed: thin walls, loose pieces, overhangs, closed voids, size");
    options->recipe.add_to(command);
    command.add_option("-o,--output", options->output, "File for the report; default: standard output")
        ->type_name("FILE");
    command.add_flag("--json", options->json, "Write the whole report as JSON");
    command.add_option("--report", options->page, "HTML file with a picture of every reported fault")
        ->type_name("FILE");
    add_survey_options(command, *options);
    command.add_flag("-q,--quiet", options->quiet, "No progress on standard error");
    finish_command(command,
                   "  lamella check model.stl --printer prusa-mk4 --layer-height 0.2\n"
                   "  lamella check insole.toml --report insole.html\n"
                   "  lamella check figure.stl --support bridges --printer marlin --check-bridges warn\n"
                   "  mpirun -n 4 lamella check insole.toml\n"
                   "Limits depend on the machine's process; `lamella keys check` lists them.\n"
                   "Exit code 1 when something fails; warnings alone are 0.");
    command.callback([options] {
        run_on_ranks([&](Ranks* ranks) { return run(*options, ranks); },
                     [&](Ranks& ranks) { run_worker(*options, ranks); });
    });
}

}  // namespace lamella
