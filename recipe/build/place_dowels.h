// Dowel holes: upright holes at the same place in every layer, for pins that align a stack.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/layers/layer.h"
#include "recipe/recipe.h"

namespace lamella {

struct DowelHoles {
    std::vector<dvec2> at;  ///< mm
    double diameter = 0;    ///< mm
    Interval height;        ///< z range through which they pass, mm
};

/// Returns true if the recipe asks for dowel holes.
bool asks_for_dowels(const Recipe& recipe);

/// Places the holes: as the recipe says, or by a survey of all layers that they pass through. Throws
/// InputError, naming the first layer that prevents it, when a hole would come nearer than its margin to the
/// border of a layer or there is no place for the requested number.
DowelHoles place_dowels(const Recipe& recipe, const Job& job);

/// Subtracts the holes from a solid.
FieldPtr without_dowels(FieldPtr solid, const DowelHoles& holes);

nlohmann::ordered_json dowels_json(const DowelHoles& holes);
/// Returns one sentence.
std::string dowels_text(const DowelHoles& holes);

}  // namespace lamella
