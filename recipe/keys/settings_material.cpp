// The rows of the settings table about a foam's modulus and its material.
#include "recipe/keys/settings_rows.h"

namespace lamella {

void add_stiffness_settings(std::vector<Setting>& t) {
    t.push_back(optional_row<&Recipe::foam, &FoamRecipe::modulus>(
        "foam", "modulus", "--modulus",
        {.unit = "MPa",
         .limits = {1e-6, 1e6},
         .fallback = "cells and members are given",
         .help = "Desired Young's modulus of the foam: determines the cells if beams (or walls) are given, "
                 "and these if cells are. Needs [material]."}));
    t.push_back(optional_row<&Recipe::foam, &FoamRecipe::law>(
        "foam", "law", "--foam-law",
        {.fallback = "the built-in laws",
         .help = "File of stiffness laws of foams (modulus over member size), as `homogenize --table` writes "
                 "it; in a recipe, relative to the recipe's folder.",
         .is_path = true}));
}

void add_material_settings(std::vector<Setting>& t) {
    const auto add = [&]<auto member>(const char* key, const char* flag, SettingSpec facts) {
        t.push_back(optional_row<&Recipe::material, member>("material", key, flag, std::move(facts)));
    };
    using M = MaterialRecipe;
    add.operator()<&M::name>(
        "name", "--material",
        {.fallback = "none", .help = "Name of a material that `lamella materials` lists: pla, petg, ..."});
    add.operator()<&M::table>(
        "table", "--material-table",
        {.fallback = "the built-in materials",
         .help = "File of materials, as `lamella materials --toml` writes them; in a recipe, relative to the "
                 "recipe's folder.",
         .is_path = true});
    add.operator()<&M::young>("young", "--young",
                              {.unit = "MPa",
                               .limits = {1e-6, 1e6},
                               .fallback = "the named material's",
                               .help = "Young's modulus of the solid, as printed."});
    add.operator()<&M::poisson>("poisson", "--poisson",
                                {.limits = {0, 0.49},
                                 .fallback = "the named material's, or 1/3",
                                 .help = "Poisson's ratio of the solid."});
    add.operator()<&M::density>("density", "--density",
                                {.unit = "g/cm3",
                                 .limits = {1e-3, 100},
                                 .fallback = "the named material's",
                                 .help = "Density of the solid, for the part's mass."});
    add.operator()<&M::tests>(
        "tests", "--material-tests",
        {.fallback = "none",
         .help = "File of compression tests of printed foams to which the law is fitted: cell (mm), member "
                 "(mm) and modulus (MPa) on each line; in a recipe, relative to the recipe's folder.",
         .is_path = true});
}

}  // namespace lamella
