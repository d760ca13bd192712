// Base materials: the elastic constants and density of the solid that foams consist of.
#pragma once

#include <string>
#include <vector>

#include "procedural/elasticity/elastic_tensor.h"
#include "recipe/recipe.h"

namespace lamella {

struct BaseMaterial {
    std::string name;           ///< empty when a recipe gives numbers only
    IsotropicMaterial elastic;  ///< MPa
    bool has_poisson = false;   ///< false: 1/3 is assumed
    double density = 0;         ///< g/cm^3; 0: unknown
    std::string product;        ///< the measured product
    std::string source;
};

/// Reads materials from TOML, one table each with young, poisson, density, product and source. `name` names
/// the text in messages. Throws InputError for invalid text, keys or values.
std::vector<BaseMaterial> read_materials(std::string_view text, const std::string& name);

/// Returns the built-in materials.
std::vector<BaseMaterial> shipped_material_list();

/// Returns true if a recipe states its material's modulus, by name or number.
inline bool has_modulus(const MaterialRecipe& recipe) { return !recipe.name.empty() || recipe.young > 0; }

/// Returns the material of a recipe's part: the named one, with the recipe's own numbers replacing its.
/// Throws InputError for an unknown name and an unreadable table.
BaseMaterial base_material(const MaterialRecipe& recipe);

}  // namespace lamella
