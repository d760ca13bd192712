// Foams chosen by modulus: the law that applies, and the cell or member sizes that follow from it.
#pragma once

#include <optional>
#include <string>

#include "procedural/elasticity/modulus_grading.h"
#include "recipe/base_material.h"
#include "recipe/build/build_gradings.h"

namespace lamella {

/// The modulus of a recipe's foam: as requested and as predicted.
struct BuiltModulus {
    std::optional<GradedUse> asked;  ///< MPa; empty when cells and members are given
    GradingPtr made;                 ///< MPa: predicted from cells and members as made
    FoamModulusPtr foam;
    BaseMaterial material;
};

/// Returns the name of a foam in files of laws: its kind and the numbers that shape it, without cell and
/// member sizes, seed and stretch. Requires that these numbers are constant.
std::string law_name(const FoamRecipe& foam);

/// Returns the foam's law, from the recipe's file or the built-in laws; nothing when it has none. Throws
/// InputError for a file that is not a valid file of laws.
std::optional<FoamLawTable> known_law(const FoamRecipe& foam);

/// Returns the law of the recipe's foam in its material, fitted to the recipe's tests; null when it is
/// unknown. Throws InputError for files that cannot be read, and for tests that do not fit.
FoamModulusPtr foam_modulus(const Recipe& recipe, const BaseMaterial& material);

/// Cells and members of a foam.
struct FoamSizes {
    GradedUse cell, member;
};

/// Returns the sizes of a foam's cells and members. If the recipe asks for a modulus, one of the two is
/// solved for, and `modulus` describes it; if it names a material whose law is known, `modulus` holds the
/// prediction. Throws InputError when a modulus is requested of a foam without a known law.
FoamSizes foam_sizes(const FoamRecipe& foam, Gradings& gradings, std::optional<BuiltModulus>& modulus);

}  // namespace lamella
