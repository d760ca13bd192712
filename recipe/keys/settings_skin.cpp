// The rows of the settings table about the skin, its pattern and its holes.
#include "recipe/keys/settings_rows.h"
#include "recipe/recipe_kinds.h"

namespace lamella {

const std::vector<std::string>& choice_names(SkinSide) {
    static const std::vector<std::string> list{"inside", "outside", "centred"};
    return list;
}

const std::vector<std::string>& choice_names(Reinforcement) {
    static const std::vector<std::string> list{"none", "shape", "forces"};
    return list;
}

namespace {

using S = SkinRecipe;
using H = HoleRecipe;

constexpr Limits widths{0.01, 1000};

template <auto member>
void add_skin_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    t.push_back(optional_row<&Recipe::skin, member>("skin", key, flag, std::move(facts)));
}

void add_thickness(std::vector<Setting>& t) {
    add_skin_row<&S::thickness>(t, "thickness", "--skin",
                                {.unit = "mm",
                                 .limits = {0, 1000},
                                 .fallback = "required in [skin]",
                                 .help = "Thickness of the skin; 0 for none."});
    add_skin_row<&S::thickness_min>(t, "thickness_min", "--skin-min",
                                    {.unit = "mm",
                                     .limits = {0, 1000},
                                     .fallback = format_value(S{}.thickness_min),
                                     .help = "Smallest thickness: a graded skin is clamped to it."});
    add_skin_row<&S::thickness_max>(t, "thickness_max", "--skin-max",
                                    {.unit = "mm",
                                     .limits = {0.001, S{}.thickness_max},
                                     .fallback = format_value(S{}.thickness_max),
                                     .help = "Largest thickness: a graded skin is clamped to it, and has "
                                             "this thickness where the formula is undefined."});
    add_skin_row<&S::side>(
        t, "side", "--skin-side",
        {.fallback = "inside",
         .help = "Side of the body's surface that the skin lies on; centred: half on either side."});
}

void add_pattern(std::vector<Setting>& t) {
    add_skin_row<&S::pattern>(t, "pattern", "--skin-pattern",
                              {.choices = kind_words("skin"),
                               .fallback = S{}.pattern,
                               .help = "Pattern of windows cut through the skin."});
    add_skin_row<&S::window>(
        t, "window", "--skin-window",
        {.unit = "mm",
         .limits = widths,
         .fallback = "required by voronoi, hexagons",
         .help = "Width of a window: across the flats of hexagons, on average for other patterns."});
    add_skin_row<&S::strut>(t, "strut", "--skin-strut",
                            {.unit = "mm",
                             .limits = widths,
                             .fallback = "required by all patterns",
                             .help = "Minimum width of the struts between windows."});
    add_skin_row<&S::corner>(t, "corner", "--skin-corner",
                             {.unit = "mm",
                              .limits = {0, 1000},
                              .fallback = "half the strut",
                              .help = "Radius of the windows' corners."});
    add_skin_row<&S::seed>(
        t, "seed", "--skin-seed",
        {.limits = {0, 9223372036854775807.0},
         .fallback = format_value(S{}.seed),
         .help = "Seed of the random numbers for Voronoi windows and patterns by example."});
}

void add_image_pattern(std::vector<Setting>& t) {
    add_skin_row<&S::image>(t, "image", "--skin-image",
                            {.fallback = "required by image, by-example",
                             .help = "Picture whose dark parts are solid, on white where it is transparent; "
                                     "in a recipe, relative to the "
                                     "recipe's folder.",
                             .is_path = true});
    add_skin_row<&S::image_size>(
        t, "image_size", "--skin-image-size",
        {.unit = "mm",
         .limits = {0.01, 1e5},
         .fallback = "required by image, by-example",
         .help = "Length that the picture's width covers; by-example takes a "
                 "formula, whose largest length is at most 3.6 times the smallest."});
    add_skin_row<&S::second_image>(t, "second_image", "--skin-second-image",
                                   {.fallback = "none",
                                    .help = "Second picture of a pattern by example, into which the first "
                                            "changes where second_weight is above 0.",
                                    .is_path = true});
    add_skin_row<&S::second_weight>(t, "second_weight", "--skin-second-weight",
                                    {.limits = {0, 1},
                                     .fallback = "required with second_image",
                                     .help = "How much a pattern by example looks like the second picture: "
                                             "0 like the first alone, 1 like the second alone."});
    add_skin_row<&S::threshold>(t, "threshold", "--skin-threshold",
                                {.limits = {0, 1},
                                 .fallback = "0.5; by-example: the value that parts the picture best (Otsu)",
                                 .help = "Grey value below which the skin is solid."});
    add_skin_row<&S::invert>(
        t, "invert", "--skin-invert",
        {.fallback = "false", .help = "Make the skin solid where the picture is bright instead of dark."});
    add_skin_row<&S::gap>(t, "gap", "--skin-gap",
                          {.unit = "mm",
                           .limits = {0, 1000},
                           .fallback = "any",
                           .help = "Minimum width of gaps in a pattern by example; struts take precedence."});
    add_skin_row<&S::reinforce>(
        t, "reinforce", "--skin-reinforce",
        {.fallback = "shape",
         .help = "How bridges make a pattern by example sounder, beyond joining its pieces: shape: no strut "
                 "alone holds a part, and no way round a gap is long; forces: also where a finite element "
                 "analysis under the loads, or squeezes from all sides, finds them most useful."});
    add_skin_row<&S::self_supporting>(
        t, "self_supporting", "--skin-self-supporting",
        {.fallback = "false",
         .help = "Put struts below the places where a pattern by example would begin in the air."});
    add_skin_row<&S::direction>(t, "direction", "--skin-direction",
                                {.limits = {-1e6, 1e6},
                                 .fallback = "as smooth as the surface allows",
                                 .help = "Direction in which the top of a pattern by example points."});
}

void add_drains(std::vector<Setting>& t) {
    add_skin_row<&S::drains>(t, "drains", "--drains",
                             {.limits = {0, 2},
                              .fallback = "0",
                              .help = "Holes per closed cavity: 1: at its lowest point; 2: also at its "
                                      "highest (needs an extra pass over the layers)."});
    add_skin_row<&S::drain_radius>(t, "drain_radius", "--drain-radius",
                                   {.unit = "mm",
                                    .limits = {0.01, 1000},
                                    .fallback = "half the skin's thickness, at least 0.5 mm",
                                    .help = "Radius of the drain holes."});
    add_skin_row<&S::drain_pitch>(t, "drain_pitch", "--drain-pitch",
                                  {.unit = "mm",
                                   .limits = {0.001, 100},
                                   .fallback = "a third of the skin's thickness, at most 16 layers",
                                   .help = "Row spacing of the survey for cavities."});
    add_skin_row<&S::tool>(
        t, "tool", "--skin-tool",
        {.fallback = "that of the part",
         .help =
             "Name of the [[tool]] (extruder) that makes all within the skin's thickness of the surface."});
}

template <auto member>
void add_hole_row(std::vector<Setting>& t, const char* key, SettingSpec facts) {
    t.push_back(list_row<&Recipe::holes, member>("hole", key, std::move(facts)));
}

void add_holes(std::vector<Setting>& t) {
    add_hole_row<&H::at>(t, "at",
                         {.unit = "mm",
                          .limits = place_limits,
                          .fallback = "required",
                          .help = "Position: the hole begins at the surface point nearest to this one."});
    add_hole_row<&H::radius>(
        t, "radius",
        {.unit = "mm", .limits = {0.01, 1e4}, .fallback = "required", .help = "Radius of the hole."});
    add_hole_row<&H::direction>(t, "direction",
                                {.limits = place_limits,
                                 .fallback = "perpendicular to the surface",
                                 .help = "Drilling direction, into the body."});
    add_hole_row<&H::depth>(t, "depth",
                            {.unit = "mm",
                             .limits = {0.001, 1e5},
                             .fallback = "through the skin",
                             .help = "Depth of the hole from the surface."});
    add_hole_row<&H::through>(
        t, "through", {.fallback = "false", .help = "Drill through the foam as well, over the whole depth."});
}

}  // namespace

void add_skin_settings(std::vector<Setting>& table) {
    add_thickness(table);
    add_pattern(table);
    add_image_pattern(table);
    add_drains(table);
    add_holes(table);
}

}  // namespace lamella
