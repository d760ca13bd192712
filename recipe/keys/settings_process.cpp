// The rows of the settings table about machine compensation.
#include "recipe/keys/settings_rows.h"

namespace lamella {

namespace {

template <auto member>
void add_process_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    t.push_back(optional_row<&Recipe::process, member>("process", key, flag, std::move(facts)));
}

}  // namespace

void add_process_settings(std::vector<Setting>& table) {
    using P = ProcessRecipe;
    add_process_row<&P::scale>(
        table, "scale", "--process-scale",
        {.limits = {0.1, 10},
         .fallback = "1, 1, 1",
         .help = "Scale factors of the finished part, including foam and skin, along x, y and z: about the "
                 "middle of its bounds in x and y, up from its lowest point."});
    add_process_row<&P::xy_compensation>(
        table, "xy_compensation", "--xy-compensation",
        {.unit = "mm",
         .limits = {-10, 10},
         .fallback = format_value(P{}.xy_compensation),
         .help = "Outward offset of every layer's outline; negative: inward."});
    add_process_row<&P::elephant_foot>(table, "elephant_foot", "--elephant-foot",
                                       {.unit = "mm",
                                        .limits = {0, 10},
                                        .fallback = format_value(P{}.elephant_foot),
                                        .help = "Inward offset of the first layer's outline."});
    add_process_row<&P::elephant_foot_layers>(
        table, "elephant_foot_layers", "--elephant-foot-layers",
        {.unit = "layers",
         .limits = {1, 10000},
         .fallback = format_value(P{}.elephant_foot_layers),
         .help =
             "Number of layers over which elephant_foot decreases linearly to 0; 1: only the first layer."});
}

}  // namespace lamella
