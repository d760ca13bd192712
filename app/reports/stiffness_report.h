// The result of a homogenisation as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "recipe/structure/foam_stiffness.h"

namespace lamella {

std::string stiffness_text(const FoamRecipe& foam, const IsotropicMaterial& material,
                           const FoamStiffness& found);
nlohmann::ordered_json stiffness_json(const FoamRecipe& foam, const IsotropicMaterial& material,
                                      const FoamStiffness& found);

}  // namespace lamella
