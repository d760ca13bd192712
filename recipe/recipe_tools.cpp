// Rules that relate the names of tools to the [[tool]] entries.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "recipe/recipe_draft.h"

namespace lamella {

void RecipeDraft::check_tools(const Recipe& recipe) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < recipe.printer.tools.size(); ++i) {
        const std::string& name = recipe.printer.tools[i].name;
        if (std::ranges::find(names, name) != names.end())
            refuse(0, fmt::format("{}: \"{}\" is the name of another [[tool]]; accepted: a name of its own",
                                  where("tool", "name", i), name.substr(0, 64)));
        names.push_back(name);
    }
    const auto check = [&](const char* section, const char* key, const std::string& name,
                           std::size_t number = 0) {
        if (name.empty() || std::ranges::find(names, name) != names.end()) return;
        const std::string near = nearest(name, names);
        refuse(0, fmt::format(
                      "{}: no [[tool]] is named \"{}\"{}; accepted: {}", where(section, key, number),
                      name.substr(0, 64), near.empty() ? "" : fmt::format(", did you mean `{}`?", near),
                      names.empty() ? "the name of a [[tool]]" : fmt::format("{}", fmt::join(names, ", "))));
    };
    check("part", "tool", recipe.part.tool);
    if (recipe.foam) check("foam", "tool", recipe.foam->tool);
    if (recipe.skin) check("skin", "tool", recipe.skin->tool);
    check("support", "tool", recipe.support_tools.tool);
    check("support", "interface_tool", recipe.support_tools.interface_tool);
    for (std::size_t i = 0; i < recipe.regions.size(); ++i)
        check("region", "tool", recipe.regions[i].tool, i);
    if (entry("support", "interface") && recipe.support_tools.interface_tool.empty())
        refuse(0, fmt::format("{}: has no effect without another tool; accepted: support.interface_tool / "
                              "--support-interface-tool as well",
                              where("support", "interface")));
}

}  // namespace lamella
