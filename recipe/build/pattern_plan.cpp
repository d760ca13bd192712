// Keeps of a recipe what its body and the pattern depend on, and hashes that.
#include "recipe/build/pattern_plan.h"

#include "procedural/pattern/pattern_file.h"
#include "recipe/build/kept_plan.h"
#include "recipe/identity.h"
#include "recipe/settings.h"

namespace lamella {

namespace {

/// Raised whenever the same recipe makes another pattern, so that plans of older versions are not taken.
constexpr const char* synthesis_version = "6";

}  // namespace

std::string pattern_hash(const Recipe& recipe, double depth) {
    Recipe kept;
    kept.part = recipe.part;
    kept.fields = recipe.fields;
    kept.gradings = recipe.gradings;
    kept.skin = recipe.skin;
    if (recipe.optimize) {  // the body is the shape that is found
        kept.regions = recipe.regions;
        kept.loads = recipe.loads;
        kept.anchors = recipe.anchors;
        kept.optimize = recipe.optimize;
        kept.foam = recipe.foam;
        kept.frame = recipe.frame;
    }
    if (recipe.skin->reinforce == Reinforcement::forces) {
        kept.regions = recipe.regions;
        kept.loads = recipe.loads;
        kept.anchors = recipe.anchors;
    }
    kept.material = recipe.material;
    Fnv128 hash;
    hash.add(synthesis_version);
    hash.add(job_identity(kept));
    hash.add(format_value(depth));
    return hash.hex();
}

SurfaceBricks pattern_plan(const Recipe& recipe, const Field& body, const SurfacePatternSettings& settings,
                           const std::filesystem::path& plans, const std::function<void()>& on_synthesis) {
    const auto make = [&] {
        const Volume picture = read_picture(recipe.skin->image);
        if (on_synthesis) on_synthesis();
        return synthesise_on_surface(picture, body, settings);
    };
    if (plans.empty()) return make();
    const std::filesystem::path file = plans / (pattern_hash(recipe, settings.depth) + ".pattern");
    if (auto kept = read_kept(file, read_surface_bricks)) return std::move(*kept);
    SurfaceBricks made = make();
    keep_if_possible(file, [&](const std::filesystem::path& to) { write_surface_bricks(to, made); });
    return made;
}

}  // namespace lamella
