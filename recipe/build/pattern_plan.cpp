// Keeps of a recipe what its body and the pattern depend on, and hashes that.
#include "recipe/build/pattern_plan.h"

#include <fstream>
#include <optional>
#include <system_error>

#include "engine/base/error.h"
#include "procedural/texture/pattern_file.h"
#include "recipe/identity.h"
#include "recipe/settings.h"

namespace lamella {

namespace {

/// Returns the pattern of a file; nothing if it is not there or damaged: then it is made anew.
std::optional<SurfaceBricks> kept_pattern(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in.is_open()) return std::nullopt;
    try {
        return read_surface_bricks(in, file.string());
    } catch (const InputError&) {
        return std::nullopt;
    }
}

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
    kept.material = recipe.material;
    Fnv128 hash;
    hash.add(job_identity(kept));
    hash.add(format_value(depth));
    return hash.hex();
}

SurfaceBricks pattern_plan(const Recipe& recipe, const Field& body, const SurfacePatternSettings& settings,
                           const std::filesystem::path& plans) {
    const auto make = [&] { return synthesise_on_surface(read_picture(recipe.skin->image), body, settings); };
    if (plans.empty()) return make();
    const std::filesystem::path file = plans / (pattern_hash(recipe, settings.depth) + ".pattern");
    if (auto kept = kept_pattern(file)) return std::move(*kept);
    SurfaceBricks made = make();
    std::error_code error;
    std::filesystem::create_directories(plans, error);
    try {
        write_surface_bricks(file, made);
    } catch (const FaultError&) {  // as for supports: the next run makes it again
    }
    return made;
}

}  // namespace lamella
