// Zones as fields: what is below the skin, regions, what is near the part.
#include "recipe/build/assign_tools.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "recipe/build/build_process.h"
#include "recipe/pieces/cut_part.h"

namespace lamella {

namespace {

/// Returns the number of a tool; that of `other` where it has no name.
int tool_number(const Recipe& recipe, const std::string& name, int other) {
    if (name.empty()) return other;
    const std::vector<ToolProfile>& tools = recipe.printer.tools;
    const auto found = std::ranges::find(tools, name, &ToolProfile::name);
    if (found == tools.end())
        throw InputError(fmt::format("{}: no [[tool]] of the plate's first recipe is named \"{}\"",
                                     recipe.part.name, name.substr(0, 64)));
    return static_cast<int>(found - tools.begin());
}

/// Returns the designed part's inside below its skin.
FieldPtr below_skin(const Recipe& recipe, const BuiltJob& built) {
    const SkinRecipe& skin = *recipe.skin;
    if (skin.side == SkinSide::outside) return built.body;
    if (skin.side == SkinSide::centred) {
        if (built.skin)
            throw InputError(
                "skin.tool: the thickness of a centred skin varies; accepted: an inside or outside skin, or "
                "one thickness");
        return make_difference(built.body, make_shell(built.body, skin.thickness.number() / 2));
    }
    const FieldPtr shell = built.skin ? make_shell(built.body, built.skin->asked, built.skin->limits)
                                      : make_shell(built.body, skin.thickness.number());
    return make_difference(built.body, shell);
}

/// Returns what is within a distance of the designed part's surface, or of a plane that cut it.
FieldPtr near_part(const Recipe& recipe, const BuiltJob& built, double distance) {
    double beyond_body = 0;
    if (recipe.skin && recipe.skin->side != SkinSide::inside)
        beyond_body = built.skin ? built.skin->limits.hi : recipe.skin->thickness.number();
    std::vector<FieldPtr> near;
    try {
        near.push_back(make_outer_shell(built.body, beyond_body + distance));
    } catch (const InputError& error) {
        throw InputError(std::string("support.interface_tool: ") + error.what() +
                         "; accepted: a mesh, another shape, or one tool for all supports");
    }
    for (const CutRecipe& cut : recipe.cuts) {
        const CutPlane plane = plane_of(cut, built.axes);
        near.push_back(make_intersection({make_half_space(plane.normal, plane.offset + distance),
                                          make_half_space(-plane.normal, distance - plane.offset)}));
    }
    return make_union(std::move(near));
}

bool uses_one_tool(const std::vector<ToolZone>& zones) {
    return std::ranges::all_of(zones, [](const ToolZone& zone) { return zone.tool == 0; });
}

}  // namespace

void assign_tools(const Recipe& recipe, BuiltJob& built) {
    Job& job = built.job;
    constexpr double beside = 1;  // mm; outlines are offset by less
    const FieldPtr about = make_box(Box{job.bounds.lo - beside, job.bounds.hi + beside});
    const auto placed = [&](const FieldPtr& designed) {
        return make_intersection({about, make_scaled(recipe, built.designed, designed)});
    };
    const int part = tool_number(recipe, recipe.part.tool, 0);
    const int inside = recipe.foam ? tool_number(recipe, recipe.foam->tool, part) : part;
    const int skin = recipe.skin ? tool_number(recipe, recipe.skin->tool, part) : inside;
    std::vector<ToolZone> zones{{skin, nullptr}};
    if (skin != inside) zones.push_back({inside, placed(below_skin(recipe, built))});
    for (const BuiltRegion& region : built.regions.list) {
        if (!region.tool.empty())
            zones.push_back({tool_number(recipe, region.tool, part), placed(region.field)});
    }
    if (!uses_one_tool(zones)) job.part_tools = std::move(zones);
    if (!job.supports) return;
    const int support = tool_number(recipe, recipe.support_tools.tool, part);
    const int interface = tool_number(recipe, recipe.support_tools.interface_tool, support);
    std::vector<ToolZone> support_zones{{support, nullptr}};
    if (interface != support) {
        support_zones.push_back(
            {interface, placed(near_part(recipe, built, recipe.support_tools.interface))});
    }
    if (!uses_one_tool(support_zones)) job.support_tools = std::move(support_zones);
}

}  // namespace lamella
