// The purge tower: a box beside the part, into which each tool extrudes when it is changed to.
#pragma once

#include <vector>

#include "engine/layers/layer.h"
#include "printers/common/profile.h"

namespace lamella {

/// Returns the numbers of the tools that make part and supports of a job, ascending.
std::vector<int> tools_of(const Job& job);

/// Returns the footprint of a tower for this many tools, mm; zero where none is needed: for a single tool,
/// and without a volume to purge. Each tool has a strip of its own along x that takes the volume in the
/// thinnest layer.
dvec2 purge_tower_size(std::size_t tools, const LayerPlan& layers, const PurgeProfile& profile);

/// Gives a job its tower, behind the part or, where the machine's plate has no room there, to its right, and
/// enlarges its bounds. The tower ends a layer above the second highest of the tools: above it one tool is
/// left. `plate` is the size of the machine's plate, mm, which may be infinite.
void add_purge_tower(Job& job, const PurgeProfile& profile, dvec2 plate);

/// The strip of a tool in a layer, divided where the tower is purged into.
struct PurgeStrip {
    Rect purged;  ///< takes the volume
    Rect rest;    ///< beside it; may be empty
};

/// Returns the strip of one of the tools of a job with a tower, in a layer of this height, mm.
PurgeStrip purge_strip(const Job& job, int tool, double height);

}  // namespace lamella
