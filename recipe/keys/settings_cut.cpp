// The rows of the settings table about cuts of the part into pieces.
#include "recipe/keys/settings_rows.h"

namespace lamella {

const std::vector<std::string>& choice_names(CutJoint) {
    static const std::vector<std::string> list{"none", "pins", "dowels"};
    return list;
}

void add_cut_settings(std::vector<Setting>& t) {
    const auto add = [&]<auto member>(const char* key, SettingSpec facts) {
        t.push_back(list_row<&Recipe::cuts, member>("cut", key, std::move(facts)));
    };
    add.operator()<&CutRecipe::at>("at", {.unit = "mm",
                                          .limits = place_limits,
                                          .fallback = "0, 0, 0",
                                          .help = "A point of the plane, in the part's coordinates."});
    add.operator()<&CutRecipe::normal>(
        "normal", {.limits = place_limits,
                   .fallback = "0, 0, 1",
                   .help = "Direction at right angles to the plane, towards the upper piece."});
    add.operator()<&CutRecipe::joint>(
        "joint", {.fallback = "none",
                  .help = "How pieces are aligned: pins of the lower one in holes of the upper one, or holes "
                          "in both for rods (dowels)."});
    add.operator()<&CutRecipe::joints>(
        "joints",
        {.limits = {0, 3},
         .fallback = "3 where there is room, or else 2",
         .help = "Number of pins or dowels between two pieces, 2 or 3, such that they fit in one way."});
    const auto length = [&]<auto member>(const char* key, Limits limits, double fallback, const char* help) {
        add.operator()<member>(
            key, {.unit = "mm", .limits = limits, .fallback = format_value(fallback), .help = help});
    };
    const CutRecipe usual;
    length.operator()<&CutRecipe::diameter>("diameter", {0.5, 100}, usual.diameter,
                                            "Diameter of a pin, or of a rod.");
    length.operator()<&CutRecipe::depth>("depth", {0.5, 1000}, usual.depth,
                                         "Length of a pin outside its piece; depth of a hole for a rod.");
    length.operator()<&CutRecipe::clearance>("clearance", {0, 10}, usual.clearance,
                                             "Gap between a pin or rod and its hole, all around.");
    length.operator()<&CutRecipe::wall>("wall", {0.1, 100}, usual.wall,
                                        "Thickness of solid material around a hole, and least distance of a "
                                        "joint from the surface.");
    length.operator()<&CutRecipe::face>(
        "face", {0, 1000}, usual.face,
        "Thickness of solid material along the cut of a part with foam; 0: none.");
}

}  // namespace lamella
