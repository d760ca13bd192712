// Overhang spans: places support points under ceilings that straight lines cannot bridge.
#pragma once

#include "engine/surveys/overhang_paths.h"

namespace lamella {

/// Places support points inside a layer, on a lattice with a pitch of one bead width, after those of its
/// paths. Considers connected regions that are farther than the growth from the layer below and farther than
/// a width from the layer's own outline. A region needs no points if it is smaller than the free stretch, or
/// if in one direction (every 22.5 degrees, and those of the layer's own bridges) all lines through it are
/// carried at both ends within the limit of a bridge.
void hold_spans(const PathQuestion& question, const SurveyedLayer& below,
                const std::vector<dvec2>& bridge_ways, SupportPlacer& placer);

}  // namespace lamella
