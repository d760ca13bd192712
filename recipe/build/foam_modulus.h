// A foam that is chosen by its modulus: which law holds, and the cells or members that follow from it.
#pragma once

#include <optional>
#include <string>

#include "procedural/elasticity/modulus_grading.h"
#include "recipe/base_material.h"
#include "recipe/build/build_gradings.h"

namespace lamella {

/// How stiff a foam of the recipe gets.
struct BuiltModulus {
    std::optional<GradedUse> asked;  ///< MPa; empty where cells and members are given
    GradingPtr made;                 ///< MPa: predicted, by cells and members as they are made
    FoamModulusPtr foam;
    BaseMaterial material;
};

/// The words that a law's file has for a foam: its kind and the numbers that shape it, but for the sizes of
/// cells and members, the seed, and what stretches it. All have to be the same everywhere.
std::string law_name(const FoamRecipe& foam);

/// The foam's law, of the recipe's file or those that ship; nothing where it is in none. Throws InputError
/// for a file that is no law's.
std::optional<FoamLawTable> known_law(const FoamRecipe& foam);

/// The law of the recipe's foam in its material, fitted to the recipe's tests; null where it is not known.
/// Throws InputError for files that cannot be read, and for tests that do not fit.
FoamModulusPtr foam_modulus(const Recipe& recipe, const BaseMaterial& material);

/// Cells and members of a foam.
struct FoamSizes {
    GradedUse cell, member;
};

/// The recipe's numbers. Where it asks for a modulus, the cells or the members are what gives it, and
/// `modulus` tells of it; where it names a material whose law is known, `modulus` predicts it. Throws
/// InputError where a modulus is asked of a foam whose law is not known.
FoamSizes foam_sizes(const FoamRecipe& foam, Gradings& gradings, std::optional<BuiltModulus>& modulus);

}  // namespace lamella
