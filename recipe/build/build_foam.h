// Makes the foam of a recipe's [foam]; the registry of its kinds.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/solids/beam.h"
#include "procedural/voronoi/seed_tree.h"
#include "recipe/build/build_gradings.h"
#include "recipe/build/foam_modulus.h"

namespace lamella {

struct BuiltFoam {
    FieldPtr field;
    GradedUse cell;                 ///< in the job's space, as all that follows
    GradedUse member;               ///< radius of the beams, or thickness of the walls of foams without beams
    std::vector<GradedUse> others;  ///< further numbers of the kind: walls, windows, stretch factors
    /// Return the beams whose solid touches a box, and the seeds in it; null for foams without beams or
    /// seeds.
    std::function<std::vector<Beam>(const Box&)> beams_touching;
    std::function<std::vector<Seed>(const Box&)> seeds_in;
    /// Period of the foam along x, y and z, mm; 0: not periodic.
    double period = 0;
    std::optional<BuiltModulus> modulus;  ///< set when the material and the foam's law are known
    /// Returns the local volume fraction at a point; null when no law is known.
    std::function<double(dvec3)> volume_fraction;
};

/// The spaces of a foam: that of the gradings (the part's), that in which its cells are made, and the job's.
/// The axes are orthogonal.
struct FoamPlace {
    Box region;               ///< that the cells fill, where they are made, mm
    glm::dmat3 from_part{1};  ///< turns the part into the space in which cells are made
    glm::dmat3 to_job{1};     ///< turns that space into the job's
    Box job_region{};         ///< where the job needs the foam, mm; unused unless `to_job` turns
    FieldPtr job_body{};      ///< for a frame; null: that of the gradings
};

/// Makes the foam, with cells that fill at least the region. Seeds repeat after `repeats_after` coarse cells;
/// 0: never.
BuiltFoam build_foam(const FoamRecipe& foam, const FoamPlace& place, Gradings& gradings,
                     std::int64_t repeats_after = 0);

/// The inputs from which a foam is made, and the result that its kind completes.
struct FoamBuildContext {
    const FoamRecipe& recipe;
    const FoamPlace& place;
    Gradings& gradings;
    const std::map<std::string, GradingPtr>& names;  ///< names that formulas may use besides the recipe's
    std::int64_t repeats_after;
    BuiltFoam& built;
};

/// Properties of a kind of foam that rules between keys depend on.
struct FoamTraits {
    bool has_faces = false;  ///< its cells have faces: it may have a [frame] where they meet the surface
    /// Its cells are closed by walls beside the beams: its law holds for one proportion of the two, and its
    /// cavities are apart unless walls have windows.
    bool is_closed = false;
    /// Range of stretch factors that may vary in space; empty: stretch and turn are the same everywhere.
    std::optional<Interval> graded_stretch{};
};

/// A kind of foam: its keys, its factory and its properties.
struct FoamBuilder {
    Kind kind;
    std::string member;  ///< key of the thickness of its members: "beam" or "wall"
    void (*make)(FoamBuildContext&);
    FoamTraits traits;

    /// Returns true if the key is an optional key of the kind.
    bool takes(std::string_view key) const { return std::ranges::find(kind.takes, key) != kind.takes.end(); }
};
std::span<const FoamBuilder> foam_builders();

/// Returns the words of the kinds with a property.
std::vector<std::string> foams_with(const std::function<bool(const FoamTraits&)>& has);

/// Returns the kind of a foam. Throws InputError when it is unknown.
const FoamBuilder& builder_of(const FoamRecipe& foam);
/// Returns the key of the thickness of a foam's members: "beam" or "wall".
inline const std::string& member_of(const FoamRecipe& foam) { return builder_of(foam).member; }

}  // namespace lamella
