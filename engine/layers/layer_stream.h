// LayerStream: layers computed ahead in parallel, handed to a back-end in order.
#pragma once

#include <functional>

#include "engine/base/cancel_token.h"
#include "engine/layers/backend.h"

namespace lamella {

/// How far a stream has come. Called from the writing thread, after each layer.
struct Progress {
    int done = 0;               ///< layers written in this run
    int total = 0;              ///< layers this run has to write
    int layer = 0;              ///< index of the layer just written
    double volume = 0;          ///< material of the part so far, mm^3
    double support_volume = 0;  ///< of its supports, mm^3
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
    int layers_kept = 0;        ///< found finished when resuming
    double volume = 0;          ///< material of the part in the layers written, mm^3
    double support_volume = 0;  ///< of its supports, mm^3
};

/// Streams the layers of a job to a back-end. Memory is bounded by the look-ahead, not by the number of
/// layers. Throws what the back-end throws, and Interrupted when cancelled.
StreamReport stream_layers(const Job& job, Backend& backend, const StreamOptions& options);

/// Streams all layers of a job through a pass that writes nothing. Throws what the pass throws, and
/// Interrupted when cancelled.
void survey_layers(const Job& job, LayerPass& pass, const PassControl& control);

}  // namespace lamella
