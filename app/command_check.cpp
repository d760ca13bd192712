// `lamella check`: whether a part can be made by a machine's process, and where it cannot.
#include <fmt/format.h>

#include <memory>

#include "app/check_page.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/prepare_job.h"
#include "app/progress.h"
#include "app/text_output.h"
#include "engine/error.h"

namespace lamella {

namespace {

struct CheckCommand : JobOptions {
    std::string output;
    std::string page;
    bool json = false;
};

CheckOutcome check_layers(const CheckCommand& options, const Recipe& recipe, const Job& job,
                          const CancelToken& cancel) {
    CheckOutcome outcome{recipe.part.name, recipe.printer.name, plan_check(recipe.printer, job, 1), {}};
    PrintCheck check(job, outcome.plan.options);
    ProgressDisplay display(options.quiet, "check: ");
    survey_layers(
        job, check, options.threads, [&](const Progress& progress) { display.show(progress); }, &cancel);
    outcome.report = check.report();
    return outcome;
}

void write(const std::string& path, const std::string& text) {
    TextOutput out(path);
    out.write(text);
    out.close();
}

void run(const CheckCommand& options) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    Recipe recipe = options.recipe.read();
    recipe.plate.copies = 1;
    const PreparedJob prepared = prepare_job(options, recipe, cancel);
    const Job& job = prepared.built.job;
    const CheckOutcome outcome = check_layers(options, recipe, job, cancel);
    write(options.output, options.json ? check_json(outcome, job).dump(2) + "\n" : check_text(outcome));
    if (!options.page.empty()) write(options.page, check_page(outcome, job));
    if (!outcome.report.passed()) throw ConstraintError(failure_text(outcome));
}

}  // namespace

void add_check_command(CLI::App& root) {
    auto options = std::make_shared<CheckCommand>();
    CLI::App& command = *root.add_subcommand(
        "check", "See whether a part can be printed: too thin, loose, in the air, closed off, too large");
    options->recipe.add_to(command);
    command.add_option("-o,--output", options->output, "File for the table; default: standard output")
        ->type_name("FILE");
    command.add_flag("--json", options->json, "All that was found, as JSON");
    command
        .add_option("--report", options->page,
                    "HTML file with a picture of every fault that is told of, for any browser")
        ->type_name("FILE");
    add_survey_options(command, *options);
    command.add_flag("-q,--quiet", options->quiet, "No progress on standard error");
    finish_command(
        command,
        "  lamella check model.stl --printer prusa-mk4 --layer-height 0.2\n"
        "  lamella check insole.toml --report insole.html\n"
        "  lamella check figure.stl --support bridges --printer marlin --check-bridges warn\n"
        "What is asked for depends on the machine's process; `lamella keys` lists it under [check].\n"
        "Exit code 1 when something fails; warnings alone are 0.");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
