// The layers of a print, as [layers] says.
#pragma once

#include <optional>

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

/// Returns the layers of a part, without its lift. `printed` has the solid whose surface layers adapt to, and
/// its bounds, as they are printed. Surveys the surface where layers adapt. Throws InputError where there
/// would be too many layers, Interrupted when cancelled.
PartLayers part_layers(const Recipe& recipe, const Job& printed, const PassControl& control);

}  // namespace lamella
