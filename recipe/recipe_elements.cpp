// Rules about discrete elements.
#include <fmt/format.h>

#include <algorithm>

#include "recipe/recipe_draft.h"
#include "recipe/recipe_regions.h"

namespace lamella {

namespace {

/// Returns whether elements make the skin, and not the body.
bool is_on_skin(const Recipe& recipe) { return recipe.skin && recipe.skin->pattern == "elements"; }

}  // namespace

/// Checks the shapes of elements, and that there is what places them.
void RecipeDraft::check_elements(const Recipe& recipe) {
    if (!recipe.elements) {
        if (is_on_skin(recipe))
            refuse(0, fmt::format("{}: nothing says how many elements the skin has; accepted: a section "
                                  "[elements] as well",
                                  where("skin", "pattern")));
        if (!recipe.element_shapes.empty() && !is_on_skin(recipe))
            refuse(0, fmt::format(
                          "{}: a shape whose copies nothing places; accepted: a section [elements] as well",
                          recipe.element_shapes.front().where));
        return;
    }
    const std::string begin = where_begins("elements", 0);
    const auto need = [&](bool is_given, const char* wrong, const char* right) {
        if (!is_given) refuse(0, fmt::format("{}: {}; accepted: {} as well", begin, wrong, right));
    };
    need(!recipe.element_shapes.empty(), "there is no shape to copy", "one or more [[element]]");
    const ElementsRecipe& elements = *recipe.elements;
    if (is_on_skin(recipe)) {
        if (elements.dimensions == 2)
            refuse(0, fmt::format("{}: elements of a skin lie in space; accepted: 3",
                                  where("elements", "dimensions")));
    } else {
        need(recipe.anchors.empty() || !recipe.loads.empty(), "nothing loads the body",
             "one or more [[load]]");
        need(recipe.loads.empty() || !recipe.anchors.empty(), "nothing holds the body",
             "one or more [[anchor]]");
        if (recipe.optimize)
            refuse(0, fmt::format("{}: conflicts with [optimize], which makes another shape of the part; "
                                  "accepted: one of them, or skin.pattern = \"elements\"",
                                  begin));
        if (!recipe.loads.empty() && elements.density != GradedNumber{1.0, ""})
            refuse(0, fmt::format("{}: loads decide where copies are; accepted: a density without [[load]] "
                                  "and [[anchor]], or loads without it",
                                  where("elements", "density")));
        if (!recipe.loads.empty() && !elements.example.empty())
            refuse(0, fmt::format("{}: loads decide where copies are; accepted: an example without [[load]] "
                                  "and [[anchor]], or loads without it",
                                  where("elements", "example")));
    }
    if (elements.scale_min > elements.scale_max)
        refuse(0, fmt::format("{}: {} is more than {}, {}; accepted: a minimum not above the maximum",
                              where("elements", "scale_min"), elements.scale_min,
                              where("elements", "scale_max"), elements.scale_max));
    for (std::size_t i = 0; i < recipe.element_shapes.size(); ++i) check_element(recipe, i);
}

void RecipeDraft::check_element(const Recipe& recipe, std::size_t number) {
    const ElementRecipe& element = recipe.element_shapes[number];
    const auto refuse_key = [&](const char* key, const std::string& wrong, const std::string& right) {
        refuse(0, fmt::format("{}: {}; accepted: {}", where("element", key, number), wrong, right));
    };
    switch (element.kind) {
        case ElementKind::stick:
            if (element.length <= element.width)
                refuse_key(
                    "length",
                    fmt::format("{} mm is not more than the width, {} mm", element.length, element.width),
                    "a length above the width");
            break;
        case ElementKind::ring:
            if (element.diameter <= 2 * element.width)
                refuse_key("diameter",
                           fmt::format("a ring {} mm wide of a tube of {} mm has no hole", element.diameter,
                                       element.width),
                           "more than twice the width");
            break;
        case ElementKind::outline:
            if (element.file.empty() && element.corners.size() < 3)
                refuse_key("corners", fmt::format("{} corners enclose nothing", element.corners.size()),
                           "three or more");
            if (recipe.elements->dimensions == 3 && element.thickness == 0 && !is_on_skin(recipe))
                refuse(0, fmt::format("{}: an outline has a thickness in three dimensions; accepted: "
                                      "element.thickness as well, or elements.dimensions = 2",
                                      element.where));
            break;
        case ElementKind::field:
            if (std::string wrong = unknown_field(recipe, where("element", "field", number), element.field);
                !wrong.empty())
                refuse(0, std::move(wrong));
            break;
    }
}

}  // namespace lamella
