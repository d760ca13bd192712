// Layer stream: renders the layers of a job in parallel and hands them to a back-end in order.
#pragma once

#include <functional>

#include "engine/base/cancel_token.h"
#include "engine/layers/backend.h"

namespace lamella {

/// The progress of a stream, reported from the writing thread after each layer.
struct Progress {
    int done = 0;               ///< layers written in this run
    int total = 0;              ///< layers this run has to write
    int layer = 0;              ///< index of the layer just written
    double volume = 0;          ///< volume of the part so far, mm^3
    double support_volume = 0;  ///< volume of the supports so far, mm^3
};

/// Threads, progress and cancellation of a pass over layers.
struct PassControl {
    int threads = 0;                                     ///< 0: one per core
    std::function<void(const Progress&)> on_progress{};  ///< may be empty
    const CancelToken* cancel = nullptr;                 ///< may be null
};

struct StreamOptions : PassControl {
    LayerRange range{};   ///< which layers
    int look_ahead = 0;   ///< layers in flight at most; 0: two per thread
    bool resume = false;  ///< continue an unfinished output
};

struct StreamReport {
    int layers_written = 0;
    int layers_kept = 0;        ///< layers of the unfinished output that was resumed
    double volume = 0;          ///< volume of the part in the layers written, mm^3
    double support_volume = 0;  ///< volume of the supports in the layers written, mm^3
};

/// Streams the layers of a job to a back-end.
///
///     Job job;
///     job.part = make_sphere({0, 0, 0}, 10);
///     job.bounds = job.part->bounds();
///     job.layers = equal_layers(job.bounds.size().z, 0.05);
///     StreamOptions options;
///     options.range = {0, job.layers.count()};
///     const StreamReport report = stream_layers(job, backend, options);
///
/// Layers are rendered in parallel and written in order. Memory is bounded by the look-ahead, not by the
/// number of layers. Throws whatever the back-end throws, InputError when the range is not within the job,
/// and Interrupted when cancelled before the last layer was written.
StreamReport stream_layers(const Job& job, Backend& backend, const StreamOptions& options);

/// Streams all layers of a job through a pass that writes nothing. Throws what the pass throws, and
/// Interrupted when cancelled.
void survey_layers(const Job& job, LayerPass& pass, const PassControl& control);

}  // namespace lamella
