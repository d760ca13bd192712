// The rows of the settings table about the heights of layers.
#include "recipe/keys/settings_rows.h"

namespace lamella {

namespace {

constexpr Limits height_limits{0.001, 10};  // mm

template <auto member>
void add_layers_row(std::vector<Setting>& t, std::string key, std::string flag, SettingSpec facts) {
    facts.unit = "mm";
    t.push_back(row<[](Recipe & r) -> auto& { return r.layers.*member; }>("layers", std::move(key),
                                                                          std::move(flag), std::move(facts)));
}

}  // namespace

void add_layers_settings(std::vector<Setting>& t) {
    using L = LayersRecipe;
    add_layers_row<&L::height>(t, "height", "--layer-height",
                               {.limits = height_limits, .fallback = "0.05", .help = "Height of a layer."});
    add_layers_row<&L::first>(
        t, "first", "--first-layer",
        {.limits = height_limits, .fallback = "as the others", .help = "Height of the first layer."});
    add_layers_row<&L::heights>(
        t, "heights", "--layer-heights",
        {.limits = {0, 10000},
         .shape = {2, 0, "pairs [[over the bed, height], ...]"},
         .fallback = "height everywhere",
         .help = "Heights of layers by how far over the bed they begin, in ascending order."});
    add_layers_row<&L::cusp>(t, "cusp", "--cusp",
                             {.limits = height_limits,
                              .fallback = "layers do not adapt",
                              .help = "Layers adapt to the surface: their steps stand off from it by no more "
                                      "than this. Needs an extra pass over the layers."});
    add_layers_row<&L::least>(t, "least", "--least-layer",
                              {.limits = height_limits,
                               .fallback = "half of height",
                               .help = "Least height of layers that adapt."});
    add_layers_row<&L::most>(t, "most", "--most-layer",
                             {.limits = height_limits,
                              .fallback = "one and a half times height",
                              .help = "Greatest height of layers that adapt."});
}

}  // namespace lamella
