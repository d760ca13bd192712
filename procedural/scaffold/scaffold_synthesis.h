// Synthesis of a scaffold: bars by greatest score, then a leg under everything that no bar holds (Dumas,
// Hergel and Lefebvre 2014, algorithm 2).
#pragma once

#include <functional>
#include <span>

#include "engine/layers/layer_stream.h"
#include "procedural/scaffold/scaffold.h"

namespace lamella {

struct SynthesisOptions {
    int threads = 0;                                 ///< 0: one per core
    std::function<void(std::size_t)> on_progress{};  ///< bars made so far; may be empty
    const CancelToken* cancel = nullptr;             ///< may be null
};

/// Returns the shape with the heights of bars and feet in whole layers, as `build_scaffold` uses it.
ScaffoldShape in_whole_layers(ScaffoldShape shape);

/// Holds the points. The part is asked for the way (see FreeSpace); what is nearer to it than the clearance
/// are contacts only. A pure function of points, part and shape, the same by any number of threads. Throws
/// InputError for a shape or points that make no sense, Interrupted when cancelled.
Scaffold build_scaffold(std::span<const SupportPoint> points, const Field& part, const ScaffoldShape& shape,
                        const SynthesisOptions& options = {});

}  // namespace lamella
