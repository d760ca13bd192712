// Runs: streams whole jobs into back-ends.
#include <fmt/format.h>

#include "bindings/handles.h"
#include "bindings/host_backend.h"
#include "recipe/output/outputs.h"

using namespace lamella;

namespace {

void stream(const lamella_job& job, Backend& backend, const lamella_run_options& options,
            lamella_run_report* report) {
    StreamOptions with;
    with.range = {options.first, options.last};
    if (options.first == 0 && options.last == 0) with.range = {0, job.job.layers.count()};
    if (options.first < 0 || with.range.count() < 1 || with.range.last > job.job.layers.count()) {
        throw BadCall(fmt::format("options: layers {} to {} are none of the {} that there are", options.first,
                                  options.last, job.job.layers.count()));
    }
    if (options.threads < 0 || options.look_ahead < 0)
        throw BadCall("options: threads or look_ahead is below 0");
    with.threads = options.threads;
    with.look_ahead = options.look_ahead;
    with.resume = (options.flags & LAMELLA_RESUME) != 0;
    with.cancel = options.cancel ? &options.cancel->token : nullptr;
    if (const auto tell = progress_to(options.progress, options.user))
        with.on_progress = [tell](const Progress& progress) { tell("layers", progress); };
    const StreamReport done = stream_layers(job.job, backend, with);
    if (report == nullptr) return;
    lamella_run_report told{};
    told.layers_written = done.layers_written;
    told.layers_kept = done.layers_kept;
    told.volume = done.volume;
    told.support_volume = done.support_volume;
    hand_out(report, told, "report");
}

lamella_run_options options_of(const lamella_run_options* given) {
    const lamella_run_options options = taken_or_usual(given, "options");
    if ((options.flags & ~std::uint32_t{LAMELLA_RESUME | LAMELLA_FORCE}) != 0)
        throw BadCall("options: flags has one that there is none of");
    return options;
}

}  // namespace

std::int32_t lamella_run(lamella_context* context, const lamella_job* job, const char* output,
                         const lamella_run_options* options, lamella_run_report* report) {
    return guarded(context, [&] {
        const lamella_run_options with = options_of(options);
        const lamella_job& made = wanted(job, "job");
        const std::vector<Output> outputs =
            read_outputs({&wanted(output, "output")}, made.recipe, made.profiles);
        const auto backend = make_outputs(outputs, (with.flags & LAMELLA_FORCE) != 0);
        stream(made, *backend, with, report);
    });
}

std::int32_t lamella_run_backend(lamella_context* context, const lamella_job* job,
                                 const lamella_backend* backend, const lamella_run_options* options,
                                 lamella_run_report* report) {
    return guarded(context, [&] {
        const lamella_run_options with = options_of(options);
        HostBackend host(taken(backend, "backend"), with.flags);
        stream(wanted(job, "job"), host, with, report);
    });
}
