// One job's layers over several processes: blocks are rendered anywhere, and written in order by the first.
#pragma once

#include <memory>
#include <span>

#include "app/ranks.h"
#include "engine/layer_stream.h"
#include "recipe/outputs.h"

namespace lamella {

/// The process of rank 0 streams layers to its outputs, of which it renders every size-th block itself and
/// gets the others from the ranks that these belong to. What is written is what one process would write.
/// Throws what stream_layers throws, and FaultError where another rank failed.
StreamReport spread_layers(Ranks& ranks, const Job& job, std::unique_ptr<Backend>& outputs,
                           const StreamOptions& options);

/// What the other processes do: they render their blocks, and send them, not further ahead than memory
/// allows. What fails is told to rank 0.
void render_blocks(Ranks& ranks, const Job& job, std::span<const Output> outputs,
                   const StreamOptions& options);

}  // namespace lamella
