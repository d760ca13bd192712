// One job's layers over several processes: blocks are rendered anywhere, and written in order by the first.
#pragma once

#include <memory>

#include "app/ranks/ranks.h"
#include "engine/layers/layer_stream.h"

namespace lamella {

/// The process of rank 0 streams layers to its outputs. It renders some of them itself, as many as it has
/// time for, and gets the others from the ranks that it has given them to. What is written is what one
/// process would write, whoever renders what. Throws what stream_layers throws, and FaultError where another
/// rank failed.
StreamReport spread_layers(Ranks& ranks, const Job& job, std::unique_ptr<Backend>& outputs,
                           const StreamOptions& options);

/// What the other processes do: their blocks are rendered by a back-end of their own that makes of a layer
/// what that of rank 0 does, and sent, not further ahead than memory allows. What fails is told to rank 0,
/// also that the job is not the same there.
void render_blocks(Ranks& ranks, const Job& job, std::unique_ptr<Backend> renderer,
                   const StreamOptions& options);

}  // namespace lamella
