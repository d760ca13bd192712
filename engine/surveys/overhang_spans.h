// Ceilings inside a layer that straight lines cannot bridge.
#pragma once

#include "engine/surveys/overhang_paths.h"

namespace lamella {

/// Places points inside a layer, on a lattice a width fine, after those of its paths. A connected region
/// further than the growth from the layer below and a width from the layer's own outline needs none where one
/// direction (every 22.5 degrees, and those of the layer's own bridges) leads through all of it from hold to
/// hold within the limit of a bridge, nor where it is smaller than the free stretch.
void hold_spans(const PathQuestion& question, const SurveyedLayer& below,
                const std::vector<dvec2>& bridge_ways, SupportPlacer& placer);

}  // namespace lamella
