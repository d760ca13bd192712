// The rows of the settings table about cavities inside the part and the shield around it.
#include "recipe/keys/settings_rows.h"

namespace lamella {

namespace {

template <auto member>
void add_cavity_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    t.push_back(optional_row<&Recipe::cavity, member>("cavity", key, flag, std::move(facts)));
}

template <auto member>
void add_shield_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    t.push_back(optional_row<&Recipe::shield, member>("shield", key, flag, std::move(facts)));
}

}  // namespace

void add_cavity_settings(std::vector<Setting>& table) {
    using C = CavityRecipe;
    add_cavity_row<&C::wall>(table, "wall", "--cavity-wall",
                             {.unit = "mm",
                              .limits = {0.05, 1000},
                              .fallback = "required in [cavity]",
                              .help = "Least thickness of what is left about a cavity, to all sides."});
    add_cavity_row<&C::overhang>(
        table, "overhang", "--cavity-overhang",
        {.unit = "mm",
         .limits = {0, 100},
         .fallback = "support.overhang",
         .help = "Distance by which a layer of a cavity's roof may stand out over the one below."});
    add_cavity_row<&C::chamber>(
        table, "chamber", "--cavity-chamber",
        {.unit = "mm",
         .limits = {0, 1000},
         .fallback = "0, undivided",
         .help = "Width of chambers that walls, a line thick, divide cavities into: for flat parts."});
    add_cavity_row<&C::least>(table, "least", "--cavity-least",
                              {.unit = "mm3",
                               .limits = {0, 1e9},
                               .fallback = format_value(C{}.least),
                               .help = "Volume below which a cavity is left solid."});
    add_cavity_row<&C::pitch>(
        table, "pitch", "--cavity-pitch",
        {.unit = "mm",
         .limits = {0, 100},
         .fallback = "half the overhang, at least 0.1",
         .help = "Distance of the rows in which the part is looked at, and width of a cavity's stairs."});
}

void add_shield_settings(std::vector<Setting>& table) {
    using S = ShieldRecipe;
    add_shield_row<&S::gap>(table, "gap", "--shield-gap",
                            {.unit = "mm",
                             .limits = {0, 1000},
                             .fallback = "required in [shield]",
                             .help = "Distance in each layer between the print and its shield, at least."});
    add_shield_row<&S::wall>(table, "wall", "--shield-wall",
                             {.unit = "mm",
                              .limits = {0.05, 100},
                              .fallback = format_value(S{}.wall),
                              .help = "Thickness of the shield."});
    add_shield_row<&S::overhang>(
        table, "overhang", "--shield-overhang",
        {.unit = "mm",
         .limits = {0, 100},
         .fallback = "support.overhang",
         .help = "Distance by which the shield's outline may move from layer to layer."});
    add_shield_row<&S::pitch>(
        table, "pitch", "--shield-pitch",
        {.unit = "mm",
         .limits = {0, 100},
         .fallback = "half the overhang, at least 0.1",
         .help = "Distance of the rows in which the print is looked at, and width of the shield's stairs."});
}

}  // namespace lamella
