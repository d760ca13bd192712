// Layer stream: a pipeline that issues indices in order, renders layers in parallel and writes products in
// order.
#include "engine/layers/layer_stream.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <optional>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace lamella {
namespace {

/// A slot for one layer in flight. The pipeline synchronises the hand-over between threads.
struct Slot {
    std::optional<Layer> layer;
    std::unique_ptr<LayerProduct> product;
};

/// One stage of the pipeline: work() with its hand-over.
template <typename Work>
class PipelineStage {
  public:
    PipelineStage(HandOver& hand_over, const Work& work) : hand_over_(hand_over), work_(work) {}

    template <typename Input>
    auto operator()(Input&& input) const {
        const HandOver::Turn turn(stage_hand_over());
        return work_(std::forward<Input>(input));
    }

  private:
    /// A function, so that tests/tsan.supp can name the one read that comes before the hand-over.
    HandOver& stage_hand_over() const { return hand_over_; }

    HandOver& hand_over_;
    Work work_;
};

/// One stream of layers: indices in order, layers rendered in parallel, products written in order. At most
/// `look_ahead` layers are in flight and they leave in order, so layer k's slot is free again when
/// k + look_ahead comes.
class LayerStream {
  public:
    LayerStream(const Job& job, LayerPass& pass, LayerRange range, int look_ahead, const PassControl& control)
        : job_(job),
          pass_(pass),
          control_(control),
          end_(range.last),
          next_(range.first),
          slots_(static_cast<std::size_t>(look_ahead)) {
        progress_.total = range.count();
    }

    /// Runs on `threads` threads. Returns false if it was cancelled before its last layer.
    bool run(int threads) {
        namespace tbb = oneapi::tbb;
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(threads));
        tbb::task_arena arena(threads);
        run_on(arena);
        return !(cancelled() && (stopped_ || next_ < end_));
    }

    const Progress& progress() const { return progress_; }

  private:
    void run_on(oneapi::tbb::task_arena& arena) {
        using namespace oneapi::tbb;
        HandOver hand_over;
        const auto stage = [&](const auto& work) { return PipelineStage(hand_over, work); };
        arena.execute([&] {
            const HandOver::Turn turn(hand_over);
            parallel_pipeline(
                slots_.size(),
                make_filter<void, int>(filter_mode::serial_in_order,
                                       stage([this](flow_control& control) { return issue(control); })) &
                    make_filter<int, int>(filter_mode::parallel,
                                          stage([this](int index) { return render(index); })) &
                    make_filter<int, void>(filter_mode::serial_in_order,
                                           stage([this](int index) { write(index); })));
        });
    }

    bool cancelled() const { return control_.cancel != nullptr && control_.cancel->cancelled(); }

    Slot& slot_of(int index) { return slots_[static_cast<std::size_t>(index) % slots_.size()]; }

    int issue(oneapi::tbb::flow_control& control) {
        if (next_ >= end_ || cancelled()) {
            control.stop();
            return -1;
        }
        return next_++;
    }

    /// Leaves the slot without a product when the stream is cancelled before or while the layer is rendered.
    int render(int index) {
        Slot& slot = slot_of(index);
        if (cancelled()) return index;
        slot.layer.emplace(job_, index, control_.cancel);
        try {
            slot.product = pass_.render(*slot.layer);
        } catch (const Interrupted&) {
            if (!cancelled()) throw;
            slot.product.reset();
        }
        return index;
    }

    /// Writes nothing from the first missing layer on.
    void write(int index) {
        Slot& slot = slot_of(index);
        stopped_ = stopped_ || !slot.product;
        if (!stopped_) {
            pass_.write(*slot.layer, *slot.product);
            ++progress_.done;
            progress_.layer = index;
            progress_.volume += slot.product->area * slot.layer->thickness();
            progress_.support_volume += slot.product->support_area * slot.layer->thickness();
            if (control_.on_progress) control_.on_progress(progress_);
        }
        slot.product.reset();
        slot.layer.reset();
    }

    const Job& job_;
    LayerPass& pass_;
    const PassControl& control_;
    int end_, next_;
    std::vector<Slot> slots_;
    Progress progress_;
    bool stopped_ = false;
};

}  // namespace

StreamReport stream_layers(const Job& job, Backend& backend, const StreamOptions& options) {
    check_range(job, options.range, TakesStacks::yes);
    const int threads = thread_count(options.threads);
    const int start = backend.open(job, options.range, options.resume);
    LayerStream stream(job, backend, {start, options.range.last},
                       options.look_ahead > 0 ? options.look_ahead : 2 * threads, options);
    const bool finished = stream.run(threads);
    const Progress& done = stream.progress();
    const StreamReport report{done.done, start - options.range.first, done.volume, done.support_volume};
    if (!finished) {
        throw Interrupted("stopped after " + std::to_string(report.layers_kept + report.layers_written) +
                          " of " + std::to_string(options.range.count()) + " layers");
    }
    backend.finish();
    return report;
}

void survey_layers(const Job& job, LayerPass& pass, const PassControl& control) {
    const LayerRange all{0, job.layers.count()};
    check_range(job, all);
    const int threads = thread_count(control.threads);
    LayerStream stream(job, pass, all, 2 * threads, control);
    if (!stream.run(threads)) {
        throw Interrupted("stopped after " + std::to_string(stream.progress().done) + " of " +
                          std::to_string(all.count()) + " layers");
    }
    pass.finish();
}

}  // namespace lamella
