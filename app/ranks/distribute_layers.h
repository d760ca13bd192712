// Distributes a job's layers over several processes: any rank renders blocks of layers, rank 0 writes them in
// order.
#pragma once

#include <memory>

#include "app/ranks/ranks.h"
#include "engine/layers/layer_stream.h"

namespace lamella {

/// Streams layers to the outputs of rank 0. It renders some of them itself, as many as it has time for, and
/// receives the others from the ranks to which it assigned them. The output equals that of a single process,
/// whichever rank renders which layer. Throws what stream_layers throws, and FaultError when another rank
/// failed.
StreamReport spread_layers(Ranks& ranks, const Job& job, std::unique_ptr<Backend>& outputs,
                           const StreamOptions& options);

/// The work of the other ranks: each renders its blocks with its own back-end, which renders layers exactly
/// as that of rank 0 does, and sends them, no further ahead than memory allows. Failures are reported to rank
/// 0; a job that differs from rank 0's is one.
void render_blocks(Ranks& ranks, const Job& job, std::unique_ptr<Backend> renderer,
                   const StreamOptions& options);

}  // namespace lamella
