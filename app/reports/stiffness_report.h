// The result of a homogenisation as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "recipe/structure/foam_stiffness.h"

namespace lamella {

/// Returns the material of the recipe's foam, with a modulus of 1 where it is unknown: results are then
/// relative to it. Throws InputError where there is no foam, and for foam that varies in space.
IsotropicMaterial homogenized_material(const Recipe& recipe);

std::string stiffness_text(const FoamRecipe& foam, const IsotropicMaterial& material,
                           const FoamStiffness& found);
nlohmann::ordered_json stiffness_json(const FoamRecipe& foam, const IsotropicMaterial& material,
                                      const FoamStiffness& found);

/// Returns {"polar", "around", "young"}: the modulus in the directions of a grid of polar angles, from +z to
/// -z, and of angles around z, from +x on; those around change fastest.
nlohmann::ordered_json directional_json(const ElasticTensor& stiffness);

/// Returns the points of the foam's law, for the material that laws are computed for: {"ratio", "density",
/// "young", "poisson", "spread"}, moduli relative to the material's; null when the foam has no law.
nlohmann::ordered_json law_json(const FoamRecipe& foam);

}  // namespace lamella
