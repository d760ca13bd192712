// Jobs with their supports, for tests of where those are.
#pragma once

#include <fmt/format.h>

#include "recipe/build/build_supports.h"
#include "tests/app/commands/boxes_mesh.h"
#include "tests/app/commands/folder.h"
#include "tests/app/commands/recipes.h"

namespace lamella {

struct Supported {
    BuiltJob built;
    std::optional<BuiltSupports> supports;

    const Job& job() const { return built.job; }
    const Scaffold& scaffold() const { return supports->plan.scaffold; }
    const std::vector<SupportPoint>& points() const { return supports->plan.scaffold.points; }
};

inline Supported supported(const std::string& text, const std::filesystem::path& plans = {},
                           int threads = 2) {
    const Recipe recipe = recipe_of(text);
    Supported s{build_job(recipe), std::nullopt};
    SupportOptions options;
    options.plans = plans;
    options.threads = threads;
    s.supports = add_supports(recipe, s.built, options);
    return s;
}

inline std::string mesh_recipe(const std::string& path) {
    return "[part]\nmesh = \"" + path + "\"\nunit = \"mm\"\n";
}

/// Parts of boxes, in a file that lives as long as this does.
class BoxPart {
  public:
    explicit BoxPart(const std::vector<Box>& boxes) { write(folder_ / "part.obj", boxes_obj(boxes)); }
    std::string recipe() const { return mesh_recipe(folder_ / "part.obj"); }

  private:
    Folder folder_;
};

inline const std::string filament = "[layers]\nheight = 0.2\n[printer]\nprofile = \"marlin\"\n";
inline const std::string resin = "[layers]\nheight = 0.05\n[printer]\nprofile = \"generic-8k\"\n";
inline const std::string ball = "[part]\nshape = \"sphere\"\nradius = 8\n";
inline const std::string koala = mesh_recipe(LAMELLA_SOURCE_DIR "/examples/models/koala_mm.obj");

/// A [[region]] that is a box.
inline std::string box_region(const std::string& make, const Box& box) {
    const dvec3 size = box.size(), at = box.center();
    return fmt::format(
        "[[field]]\nname = \"{0}\"\nkind = \"box\"\nsize = [{1}, {2}, {3}]\nat = [{4}, {5}, {6}]\n"
        "[[region]]\nfield = \"{0}\"\nmake = \"{0}\"\n",
        make, size.x, size.y, size.z, at.x, at.y, at.z);
}

}  // namespace lamella
