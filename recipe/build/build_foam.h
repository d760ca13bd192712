// From the recipe's [foam] to the foam: kinds are registered here, a line each.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/solids/beam.h"
#include "procedural/voronoi/seed_tree.h"
#include "recipe/build/build_gradings.h"
#include "recipe/build/foam_modulus.h"

namespace lamella {

struct BuiltFoam {
    FieldPtr field;
    GradedUse cell;
    GradedUse member;               ///< radius of the beams; of foams without them, thickness of the walls
    std::vector<GradedUse> others;  ///< further numbers of the kind: walls, windows, stretches
    /// The beams whose solid touches a box, and the seeds in it; null for foams that have none.
    std::function<std::vector<Beam>(const Box&)> beams_touching;
    std::function<std::vector<Seed>(const Box&)> seeds_in;
    /// After which the foam repeats along x, y and z, mm; 0: it does not.
    double period = 0;
    std::optional<BuiltModulus> modulus;  ///< where the material and the foam's law are known
    /// The share of space that is solid about a point; null where no law is known.
    std::function<double(dvec3)> volume_fraction;
};

/// The foam, cells filling at least the region. Seeds repeat after so many coarse cells; 0: never.
BuiltFoam build_foam(const FoamRecipe& foam, const Box& region, Gradings& gradings,
                     std::int64_t repeats_after = 0);

/// A foam in the making: what its cells and members have become of already, and what its kind adds.
struct FoamBuildContext {
    const FoamRecipe& recipe;
    const Box& region;
    Gradings& gradings;
    const std::map<std::string, GradingPtr>& names;  ///< that formulas may use besides the recipe's
    std::int64_t repeats_after;
    BuiltFoam& built;
};

/// A kind of foam: its keys, and how it is made.
struct FoamBuilder {
    Kind kind;
    std::string member;  ///< the key that says how thick its members are: "beam" or "wall"
    void (*make)(FoamBuildContext&);
};
std::span<const FoamBuilder> foam_builders();

/// The kind of a foam. Throws InputError where it is unknown.
const FoamBuilder& builder_of(const FoamRecipe& foam);
/// The key of the foam that says how thick its members are: "beam" or "wall".
inline const std::string& member_of(const FoamRecipe& foam) { return builder_of(foam).member; }

}  // namespace lamella
