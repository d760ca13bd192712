// Synthesis of a scaffold: bars in order of score, then a leg under each element that no bar supports (Dumas,
// Hergel and Lefebvre 2014, algorithm 2).
#pragma once

#include <functional>
#include <span>

#include "engine/layers/layer_stream.h"
#include "procedural/scaffold/scaffold.h"

namespace lamella {

struct SynthesisOptions {
    int threads = 0;  ///< 0: one per core
    /// called with the number of bars made so far; may be empty
    std::function<void(std::size_t)> on_progress{};
    const CancelToken* cancel = nullptr;  ///< may be null
};

/// Returns the shape with the heights of bars and feet rounded up to whole layers, as `build_scaffold` uses
/// it.
ScaffoldShape in_whole_layers(ScaffoldShape shape);

/// Synthesises a scaffold that supports the points. Clearances are queried from the part itself (see
/// FreeSpace); only contacts come closer to it than `clearance`. A pure function of points, part and shape,
/// the same with any number of threads. Throws InputError for invalid shapes or points, Interrupted when
/// cancelled.
Scaffold build_scaffold(std::span<const SupportPoint> points, const Field& part, const ScaffoldShape& shape,
                        const SynthesisOptions& options = {});

}  // namespace lamella
