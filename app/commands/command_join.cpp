// `lamella join`: joins shards of a job, made on several machines, into its outputs.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/prepare_job.h"
#include "app/console/interrupt.h"
#include "app/console/progress.h"
#include "engine/base/error.h"
#include "printers/archive/shard_file.h"
#include "printers/common/carried_layers.h"
#include "recipe/output/outputs.h"
#include "recipe/output/render_only.h"

namespace lamella {

namespace {

struct JoinCommand : JobOptions {
    std::vector<std::string> shards;
    std::vector<std::string> output;
    bool force = false;
    std::string repeat;  ///< the command line that continues this run
};

void run(const JoinCommand& options) {
    ProgressDisplay display(options.quiet);
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const Recipe recipe = options.recipe.read();
    const std::vector<Output> outputs = read_outputs(options.output, recipe, options.recipe.profiles());
    if (!options.layers.empty())
        throw InputError("--layers: join always uses all layers; accepted: join without --layers");
    const PreparedJob prepared = prepare_job(options, recipe, cancel);
    const Job& job = prepared.built.job;
    const auto shards =
        open_shards(options.shards, {job.identity, settings_of(outputs), prepared.stream.range});
    const auto fetch = [&](int layer) -> std::optional<std::string> {
        const auto after = std::ranges::upper_bound(
            shards, layer, {}, [](const auto& shard) { return shard->stamp().range.first; });
        return (*std::prev(after))->layer(layer);
    };
    const auto backend = make_fetching(make_outputs(outputs, options.force), fetch);
    StreamOptions stream = prepared.stream;
    stream.on_progress = [&](const Progress& progress) { display.show(progress); };
    try {
        stream_layers(job, *backend, stream);
    } catch (const Interrupted&) {
        display.finish();
        throw Interrupted("interrupted; what is finished is kept. To go on: " + options.repeat);
    }
    display.finish();
    if (options.quiet) return;
    for (const std::string& note : backend->notes()) std::fputs(("note: " + note + "\n").c_str(), stderr);
    std::fputs(fmt::format("{}: {} layers of {} shards in {:.2f} s\n", outputs.front().path,
                           stream.range.count(), shards.size(), display.seconds())
                   .c_str(),
               stderr);
}

}  // namespace

void add_join_command(CLI::App& root, const std::vector<std::string>& arguments) {
    auto options = std::make_shared<JoinCommand>();
    options->repeat = resuming(arguments);
    CLI::App& command = *root.add_subcommand(
        "join", "Join shards of a job, made by `slice --shard` on several machines, into its outputs");
    options->recipe.add_to(command);
    command.add_option("--shards", options->shards, "All shards of the job, in any order")
        ->type_name("FILE")
        ->required();
    command
        .add_option("-o,--output", options->output,
                    "Outputs as for `slice`, for the same machines as the shards")
        ->type_name("PATH[@PROFILE]")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_job_options(command, *options);
    command.add_flag("--resume", options->resume, "Continue an unfinished output of the same job");
    command.add_flag("--force", options->force, "Replace an existing output");
    command.add_flag("-q,--quiet", options->quiet, "No progress on standard error");
    finish_command(command,
                   "  lamella slice insole.toml -o insole.sl1 --layers 0:400 --shard a.shard    # here\n"
                   "  lamella slice insole.toml -o insole.sl1 --layers 400: --shard b.shard     # and there\n"
                   "  lamella join insole.toml -o insole.sl1 --shards a.shard b.shard\n"
                   "The output has the bytes that one run would have written.");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
