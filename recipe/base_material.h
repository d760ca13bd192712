// Base materials: how stiff the solid is that foams are made of.
#pragma once

#include <string>
#include <vector>

#include "procedural/elasticity/elastic_tensor.h"
#include "recipe/recipe.h"

namespace lamella {

struct BaseMaterial {
    std::string name;           ///< empty where a recipe's numbers say it all
    IsotropicMaterial elastic;  ///< MPa
    bool has_poisson = false;   ///< or a third is assumed
    double density = 0;         ///< g/cm^3; 0: not known
    std::string product;        ///< that was measured
    std::string source;
};

/// Reads materials: a TOML table each, with young, poisson, density, product and source. `name` stands in
/// messages. Throws InputError.
std::vector<BaseMaterial> read_materials(std::string_view text, const std::string& name);

/// Those that ship with the program.
std::vector<BaseMaterial> shipped_material_list();

/// Whether a recipe says how stiff its material is, by a name or a number.
inline bool has_modulus(const MaterialRecipe& recipe) { return !recipe.name.empty() || recipe.young > 0; }

/// What a recipe's part is made of: the named material with the recipe's own numbers over it. Throws
/// InputError for an unknown name and an unreadable table.
BaseMaterial base_material(const MaterialRecipe& recipe);

}  // namespace lamella
