// The rows of the settings table about named solids and regions.
#include "recipe/keys/settings_rows.h"
#include "recipe/recipe_kinds.h"

namespace lamella {

const std::vector<std::string>& choice_names(RegionMake) {
    static const std::vector<std::string> list{"solid",   "empty",    "foam", "skin",
                                               "blocker", "enforcer", "tool", "layers"};
    return list;
}

namespace {

template <auto member>
void add_field_row(std::vector<Setting>& t, const char* key, SettingSpec facts) {
    t.push_back(list_row<&Recipe::fields, member>("field", key, std::move(facts)));
}

void add_formulas(std::vector<Setting>& t) {
    add_field_row<&FieldRecipe::formula>(
        t, "formula",
        {.fallback = "required by formula",
         .help = "Formula over x, y, z (mm): the solid is where it is below zero.",
         .is_formula = true});
    add_field_row<&FieldRecipe::file>(
        t, "file",
        {.fallback = "required by vm, mesh, 3mf",
         .help = "Program with one operation per line (.vm), a mesh (STL, OBJ, PLY, 3MF), or a 3MF with "
                 "level sets, beams or functions, relative to the recipe's folder.",
         .is_path = true});
    add_field_row<&FieldRecipe::object>(
        t, "object",
        {.fallback = "all built objects of the 3MF", .help = "Number or name of an object in a 3MF."});
    add_field_row<&FieldRecipe::function>(
        t, "function",
        {.fallback = "none",
         .help = "Number or name of a function in a 3MF, with .output if it has several outputs: the solid "
                 "is where it is below zero."});
    add_field_row<&FieldRecipe::bounds>(t, "bounds",
                                        {.unit = "mm",
                                         .limits = place_limits,
                                         .shape = {3, 2, "two corners [[x, y, z], [x, y, z]]"},
                                         .fallback = "found by a search; for a region, a box around the part",
                                         .help = "Box around the solid, which is cut off outside it."});
}

void add_shapes(std::vector<Setting>& t) {
    const auto length = [&]<auto member>(const char* key, const char* needed_by, const char* help) {
        add_field_row<member>(t, key,
                              {.unit = "mm",
                               .limits = extent_limits,
                               .fallback = std::string("required by ") + needed_by,
                               .help = help});
    };
    length.operator()<&FieldRecipe::radius>("radius", "sphere, cylinder, capsule, torus",
                                            "Radius; for a torus, that of the centre line of its tube.");
    length.operator()<&FieldRecipe::size>("size", "box", "Edge lengths along x, y and z.");
    length.operator()<&FieldRecipe::height>("height", "cylinder, capsule",
                                            "Height from end to end, along z.");
    length.operator()<&FieldRecipe::tube>("tube", "torus", "Radius of the tube of a torus.");
    add_field_row<&FieldRecipe::unit>(
        t, "unit", {.fallback = "mm", .help = "Length unit of a mesh file whose format states none."});
    add_field_row<&FieldRecipe::scale>(
        t, "scale",
        {.limits = {1e-6, 1e6}, .fallback = "1", .help = "Scale factor of a mesh, applied after the unit."});
}

}  // namespace

void add_field_settings(std::vector<Setting>& t) {
    add_field_row<&FieldRecipe::name>(
        t, "name",
        {.fallback = "required", .help = "Name, for part.field and regions to use: letters, digits and _."});
    add_field_row<&FieldRecipe::kind>(t, "kind",
                                      {.choices = kind_words("field"),
                                       .fallback = "formula",
                                       .help = "Kind of the field: a formula, a file or a shape."});
    add_formulas(t);
    add_shapes(t);
    add_field_row<&FieldRecipe::at>(
        t, "at",
        {.unit = "mm",
         .limits = place_limits,
         .fallback = "0, 0, 0",
         .help = "Centre of a shape; for a mesh or formula, the position of its origin."});
    add_field_row<&FieldRecipe::turn>(
        t, "turn",
        {.unit = "degrees",
         .limits = {-360, 360},
         .fallback = "0, 0, 0",
         .help = "Rotation of the solid about x, then y, then z, before it is moved."});
}

void add_region_settings(std::vector<Setting>& t) {
    const auto add = [&]<auto member>(const char* key, SettingSpec facts) {
        t.push_back(list_row<&Recipe::regions, member>("region", key, std::move(facts)));
    };
    add.operator()<&RegionRecipe::field>(
        "field", {.fallback = "required", .help = "Name of the [[field]] whose inside is the region."});
    add.operator()<&RegionRecipe::make>(
        "make", {.fallback = "required",
                 .help = "Content of the body in the region; foam and skin change numbers, tool the extruder "
                         "alone, layers their height alone. A blocker keeps supports away, an enforcer puts "
                         "them under every overhang."});
    add.operator()<&RegionRecipe::blend>(
        "blend", {.unit = "mm",
                  .limits = {0, 1000},
                  .fallback = "0",
                  .help = "Width of the transition between the region and its surroundings: of fillets, "
                          "rounded edges, changing numbers."});
    const auto number = [&]<auto member>(const char* key, const char* unit, Limits limits, const char* other,
                                         const char* help) {
        add.operator()<member>(key, {.unit = unit, .limits = limits, .fallback = other, .help = help});
    };
    number.operator()<&RegionRecipe::cell>("cell", "mm", {0.05, 1000}, "the foam's",
                                           "Cell size of the foam in the region.");
    number.operator()<&RegionRecipe::beam>("beam", "mm", {0.005, 500}, "the foam's",
                                           "Radius of the foam's beams in the region.");
    number.operator()<&RegionRecipe::wall>("wall", "mm", {0.01, 500}, "the foam's",
                                           "Thickness of the foam's walls in the region.");
    number.operator()<&RegionRecipe::window>("window", "", {0, 1}, "the foam's",
                                             "Open share of a closed foam's walls in the region.");
    number.operator()<&RegionRecipe::modulus>("modulus", "MPa", {1e-6, 1e6}, "the foam's",
                                              "Young's modulus of the foam in the region.");
    number.operator()<&RegionRecipe::thickness>("thickness", "mm", {0, 1000}, "required by skin",
                                                "Thickness of the skin in the region; 0 for none.");
    add.operator()<&RegionRecipe::tool>("tool",
                                        {.fallback = "required by tool; else as around the region",
                                         .help = "Name of the [[tool]] that makes what is in the region."});
    add.operator()<&RegionRecipe::layer_height>(
        "layer_height",
        {.unit = "mm",
         .limits = {0.001, 10},
         .fallback = "required by layers; else as around the region",
         .help = "Height of all layers that begin at the heights of the region's part of the body; with "
                 "layers.cusp, their greatest height."});
}

}  // namespace lamella
