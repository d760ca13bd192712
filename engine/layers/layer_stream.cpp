// Layer stream: a pipeline that issues indices in order, renders layers in parallel and writes products in
// order.
#include "engine/layers/layer_stream.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <mutex>
#include <optional>
#include <vector>

#include "engine/base/error.h"

namespace lamella {
namespace {

/// A slot for one layer in flight. The pipeline itself synchronises the hand-over between threads; the lock
/// makes it visible to tools that cannot see into the pipeline, such as a race detector.
struct Slot {
    std::mutex busy;
    std::optional<Layer> layer;
    std::unique_ptr<LayerProduct> product;
};

/// Locks and unlocks every mutex when the stream is left, on any path, so that a race detector sees that the
/// threads' work happened before.
struct Rejoin {
    std::mutex& in_order;
    std::vector<Slot>& slots;
    ~Rejoin() {
        for (Slot& slot : slots) const std::lock_guard lock(slot.busy);
        const std::lock_guard lock(in_order);
    }
};

void check_range(const Job& job, const LayerRange& range) {
    if (range.first < 0 || range.last > job.layer_count || range.first >= range.last) {
        throw InputError("layers " + std::to_string(range.first) + ":" + std::to_string(range.last) +
                         " are not in this job; it has layers 0:" + std::to_string(job.layer_count));
    }
}

}  // namespace

std::string pack(LayerProduct& product) {
    Archive parcel;
    parcel(product.area, product.support_area);
    product.serialize(parcel);
    return parcel.bytes();
}

void unpack(std::string bytes, LayerProduct& product) {
    Archive parcel(std::move(bytes));
    parcel(product.area, product.support_area);
    product.serialize(parcel);
    parcel.finish();
}

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

    // At most `look_ahead` layers are in flight and they leave in order, so the slot of layer k is free again
    // when layer k + look_ahead is issued.
    std::vector<Slot> slots(static_cast<std::size_t>(look_ahead));
    std::mutex in_order;
    const auto slot_of = [&](int index) -> Slot& {
        const std::lock_guard lock(in_order);
        return slots[static_cast<std::size_t>(index) % slots.size()];
    };
    int next = start;
    bool stopped = false;
    const auto issue = [&](tbb::flow_control& control) -> int {
        const std::lock_guard lock(in_order);
        if (next >= options.range.last || cancelled()) {
            control.stop();
            return -1;
        }
        return next++;
    };
    const auto render = [&](int index) {
        Slot& slot = slot_of(index);
        const std::lock_guard lock(slot.busy);
        if (cancelled()) return index;  // do not begin another layer
        slot.layer.emplace(job, index, options.cancel);
        try {
            slot.product = backend.render(*slot.layer);
        } catch (const Interrupted&) {
            if (!cancelled()) throw;
            slot.product.reset();  // drop the unfinished layer
        }
        return index;
    };
    const auto write = [&](int index) {
        Slot& slot = slot_of(index);
        const std::lock_guard lock(slot.busy);
        stopped = stopped || !slot.product;
        if (stopped) {  // a layer after a missing one cannot be written
            slot.product.reset();
            slot.layer.reset();
            return;
        }
        backend.write(*slot.layer, *slot.product);
        ++report.layers_written;
        report.volume += slot.product->area * slot.layer->thickness();
        report.support_volume += slot.product->support_area * slot.layer->thickness();
        progress.done = report.layers_written;
        progress.layer = index;
        progress.volume = report.volume;
        progress.support_volume = report.support_volume;
        if (options.on_progress) options.on_progress(progress);
        slot.product.reset();
        slot.layer.reset();
        const std::lock_guard done(in_order);
    };

    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute([&] {
        const Rejoin rejoin{in_order, slots};
        tbb::parallel_pipeline(static_cast<std::size_t>(look_ahead),
                               tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order, issue) &
                                   tbb::make_filter<int, int>(tbb::filter_mode::parallel, render) &
                                   tbb::make_filter<int, void>(tbb::filter_mode::serial_in_order, write));
    });
    if (cancelled() && (stopped || next < options.range.last)) {
        throw Interrupted("stopped after " + std::to_string(report.layers_kept + report.layers_written) +
                          " of " + std::to_string(options.range.count()) + " layers");
    }
    backend.end();
    return report;
}

void survey_layers(const Job& job, Backend& surveyor, int threads,
                   const std::function<void(const Progress&)>& on_progress, const CancelToken* cancel) {
    StreamOptions options;
    options.range = {0, job.layer_count};
    options.threads = threads;
    options.on_progress = on_progress;
    options.cancel = cancel;
    stream_layers(job, surveyor, options);
}

}  // namespace lamella
