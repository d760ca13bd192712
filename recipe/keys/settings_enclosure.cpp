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
                              .help = "Minimum wall thickness around a cavity, in all directions."});
    add_cavity_row<&C::overhang>(
        table, "overhang", "--cavity-overhang",
        {.unit = "mm",
         .limits = {0, 100},
         .fallback = "support.overhang",
         .help = "Largest overhang of a layer of a cavity's roof over the one below."});
    add_cavity_row<&C::chamber>(table, "chamber", "--cavity-chamber",
                                {.unit = "mm",
                                 .limits = {0, 1000},
                                 .fallback = "0, undivided",
                                 .help = "Width of the chambers into which walls of one line's thickness "
                                         "divide cavities: for flat parts."});
    add_cavity_row<&C::least>(table, "least", "--cavity-least",
                              {.unit = "mm3",
                               .limits = {0, 1e9},
                               .fallback = format_value(C{}.least),
                               .help = "Minimum volume of a cavity; smaller ones are left solid."});
    add_cavity_row<&C::pitch>(
        table, "pitch", "--cavity-pitch",
        {.unit = "mm",
         .limits = {0, 100},
         .fallback = "half the overhang, at least 0.1",
         .help = "Row spacing of the survey of the part, and step width of a cavity's roof."});
}

void add_shield_settings(std::vector<Setting>& table) {
    using S = ShieldRecipe;
    add_shield_row<&S::gap>(table, "gap", "--shield-gap",
                            {.unit = "mm",
                             .limits = {0, 1000},
                             .fallback = "required in [shield]",
                             .help = "Minimum distance between the print and its shield in each layer."});
    add_shield_row<&S::wall>(table, "wall", "--shield-wall",
                             {.unit = "mm",
                              .limits = {0.05, 100},
                              .fallback = format_value(S{}.wall),
                              .help = "Thickness of the shield."});
    add_shield_row<&S::overhang>(table, "overhang", "--shield-overhang",
                                 {.unit = "mm",
                                  .limits = {0, 100},
                                  .fallback = "support.overhang",
                                  .help = "Largest shift of the shield's outline from layer to layer."});
    add_shield_row<&S::pitch>(
        table, "pitch", "--shield-pitch",
        {.unit = "mm",
         .limits = {0, 100},
         .fallback = "half the overhang, at least 0.1",
         .help = "Row spacing of the survey of the print, and step width of the shield's outline."});
}

}  // namespace lamella
