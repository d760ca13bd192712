// LayerHeights: the heights of layers that a format can say, or a machine can print.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "engine/layers/backend.h"

namespace lamella {

/// Whether the layers of a print may have different heights: none, the first one, all.
enum class LayerHeights : unsigned char { equal, first, any };

/// Throws InputError, which names the format, for layers of a range that differ more than is allowed.
void check_layer_heights(LayerHeights allowed, const LayerPlan& layers, LayerRange range,
                         std::string_view format);

/// Returns the height of all layers of a range, mm. Throws InputError, which names the format, where they
/// differ.
double equal_layer_height(const LayerPlan& layers, LayerRange range, std::string_view format);

/// Returns the height of equal layers, or else [count, height] for each run of equal layers, lowest first;
/// mm.
nlohmann::ordered_json layer_heights_json(const LayerPlan& layers);

}  // namespace lamella
