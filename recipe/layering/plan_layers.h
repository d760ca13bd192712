// The layers of a print, as [layers] says.
#pragma once

#include <optional>
#include <vector>

#include "engine/layers/layer_stream.h"
#include "recipe/recipe.h"

namespace lamella {

/// Returns the layers between the bed and a part that stands on supports: its lift, rounded up to whole
/// layers; none for a part that lies on the bed.
LayerPlan lift_layers(const Recipe& recipe);

/// The layers of a part.
struct PartLayers {
    LayerPlan plan;
    std::optional<double> cusp;  ///< largest distance between steps and surface, mm; empty: not surveyed
};

/// Heights of a part, as it is printed, at which layers are this high: those of a region.
struct HeightBand {
    Interval z;         ///< in the coordinates of the part's bounds, mm
    double height = 0;  ///< of the layers that begin within, mm; at most this, where layers adapt
};

/// Returns the layers of a part, without its lift. `printed` has the solid whose surface layers adapt to, and
/// its bounds, as they are printed. Of bands that overlap, the later one holds. Surveys the surface where
/// layers adapt. Throws InputError where there would be too many layers, Interrupted when cancelled.
PartLayers part_layers(const Recipe& recipe, const Job& printed, const std::vector<HeightBand>& bands,
                       const PassControl& control);

}  // namespace lamella
