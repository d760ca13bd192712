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
    Interval height;        ///< which they pass through, mm
};

/// Whether a recipe asks for any.
bool asks_for_dowels(const Recipe& recipe);

/// Where the holes go: as the recipe says, or found by a survey of all layers that they pass through. Throws
/// InputError, naming the first layer that stands against it, where a hole would come nearer than its margin
/// to the border of a layer or where there is no place for so many.
DowelHoles place_dowels(const Recipe& recipe, const Job& job);

/// The solid less the holes.
FieldPtr without_dowels(FieldPtr solid, const DowelHoles& holes);

nlohmann::ordered_json dowels_json(const DowelHoles& holes);
/// One sentence.
std::string dowels_text(const DowelHoles& holes);

}  // namespace lamella
