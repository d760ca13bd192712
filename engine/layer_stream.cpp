// The pipeline: indices in order, layers rendered in parallel, products written in order.
#include "engine/layer_stream.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include "engine/error.h"

namespace lamella {
namespace {

/// A layer on its way through the pipeline.
struct InFlight {
    explicit InFlight(const Job& job, int index) : layer(job, index) {}
    Layer layer;
    std::unique_ptr<LayerProduct> product;
};

void check_range(const Job& job, const LayerRange& range) {
    if (range.first < 0 || range.last > job.layer_count || range.first >= range.last) {
        throw InputError("layers " + std::to_string(range.first) + ":" + std::to_string(range.last) +
                         " are not in this job; it has layers 0:" + std::to_string(job.layer_count));
    }
}

}  // namespace

StreamReport stream_layers(const Job& job, Backend& backend, const StreamOptions& options) {
    namespace tbb = oneapi::tbb;
    check_range(job, options.range);
    const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
    const int look_ahead = options.look_ahead > 0 ? options.look_ahead : 2 * threads;
    const auto cancelled = [&] { return options.cancel != nullptr && options.cancel->cancelled(); };

    const int start = backend.begin(job, options.range, options.resume);
    StreamReport report;
    report.layers_kept = start - options.range.first;
    Progress progress;
    progress.total = options.range.last - start;

    int next = start;
    const auto issue = [&](tbb::flow_control& control) -> int {
        if (next >= options.range.last || cancelled()) {
            control.stop();
            return -1;
        }
        return next++;
    };
    const auto render = [&](int index) {
        auto flying = std::make_shared<InFlight>(job, index);
        flying->product = backend.render(flying->layer);
        return flying;
    };
    const auto write = [&](const std::shared_ptr<InFlight>& flying) {
        backend.write(flying->layer, *flying->product);
        ++report.layers_written;
        report.volume += flying->product->area * flying->layer.thickness();
        progress.done = report.layers_written;
        progress.layer = flying->layer.index();
        progress.volume = report.volume;
        if (options.on_progress) options.on_progress(progress);
    };

    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute([&] {
        tbb::parallel_pipeline(
            static_cast<std::size_t>(look_ahead),
            tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order, issue) &
                tbb::make_filter<int, std::shared_ptr<InFlight>>(tbb::filter_mode::parallel, render) &
                tbb::make_filter<std::shared_ptr<InFlight>, void>(tbb::filter_mode::serial_in_order, write));
    });
    if (cancelled() && next < options.range.last) {
        throw Interrupted("stopped after " + std::to_string(report.layers_kept + report.layers_written) +
                          " of " + std::to_string(options.range.count()) + " layers");
    }
    backend.end();
    return report;
}

}  // namespace lamella
