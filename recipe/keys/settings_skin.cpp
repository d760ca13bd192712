// The rows of the settings table about the skin, its pattern and its holes.
#include "recipe/keys/settings_rows.h"
#include "recipe/recipe_kinds.h"

namespace lamella {

const std::vector<std::string>& choice_names(SkinSide) {
    static const std::vector<std::string> list{"inside", "outside", "centred"};
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
    add_skin_row<&S::thickness_min>(
        t, "thickness_min", "--skin-min",
        {.unit = "mm",
         .limits = {0, 1000},
         .fallback = format_value(S{}.thickness_min),
         .help = "Least thickness that is made: a graded skin is kept above it."});
    add_skin_row<&S::thickness_max>(
        t, "thickness_max", "--skin-max",
        {.unit = "mm",
         .limits = {0.001, S{}.thickness_max},
         .fallback = format_value(S{}.thickness_max),
         .help = "Greatest thickness that is made: a graded skin is kept below it, and has it where the "
                 "formula has no number."});
    add_skin_row<&S::side>(
        t, "side", "--skin-side",
        {.fallback = "inside",
         .help = "Side of the body's surface that the skin lies on; centred: half on either side."});
}

void add_pattern(std::vector<Setting>& t) {
    add_skin_row<&S::pattern>(t, "pattern", "--skin-pattern",
                              {.choices = kind_words("skin"),
                               .fallback = S{}.pattern,
                               .help = "Windows that are cut through the skin."});
    add_skin_row<&S::window>(
        t, "window", "--skin-window",
        {.unit = "mm",
         .limits = widths,
         .fallback = "required by voronoi, hexagons",
         .help = "Width of a window: of hexagons from side to side, of others on average."});
    add_skin_row<&S::strut>(t, "strut", "--skin-strut",
                            {.unit = "mm",
                             .limits = widths,
                             .fallback = "required by all patterns",
                             .help = "Width of what is left between windows; no strut is narrower."});
    add_skin_row<&S::corner>(t, "corner", "--skin-corner",
                             {.unit = "mm",
                              .limits = {0, 1000},
                              .fallback = "half the strut",
                              .help = "Radius of the windows' corners."});
    add_skin_row<&S::seed>(t, "seed", "--skin-seed",
                           {.limits = {0, 9223372036854775807.0},
                            .fallback = format_value(S{}.seed),
                            .help = "Number that picks one set of Voronoi windows among all."});
}

void add_image_pattern(std::vector<Setting>& t) {
    add_skin_row<&S::image>(
        t, "image", "--skin-image",
        {.fallback = "required by image",
         .help = "Picture whose dark parts are solid; in a recipe, relative to the recipe's folder.",
         .is_path = true});
    add_skin_row<&S::image_size>(t, "image_size", "--skin-image-size",
                                 {.unit = "mm",
                                  .limits = {0.01, 1e5},
                                  .fallback = "required by image",
                                  .help = "Length that the picture's width covers."});
    add_skin_row<&S::threshold>(
        t, "threshold", "--skin-threshold",
        {.limits = {0, 1}, .fallback = format_value(S{}.threshold), .help = "Grey below which it is solid."});
    add_skin_row<&S::invert>(t, "invert", "--skin-invert",
                             {.fallback = "false", .help = "Solid where the picture is bright instead."});
}

void add_drains(std::vector<Setting>& t) {
    add_skin_row<&S::drains>(
        t, "drains", "--drains",
        {.limits = {0, 2},
         .fallback = "0",
         .help = "Holes for each closed cavity: 1 at its lowest point, 2 one at its highest, too; the layers "
                 "are surveyed first."});
    add_skin_row<&S::drain_radius>(t, "drain_radius", "--drain-radius",
                                   {.unit = "mm",
                                    .limits = {0.01, 1000},
                                    .fallback = "half the skin's thickness, at least 0.5 mm",
                                    .help = "Radius of these holes."});
    add_skin_row<&S::drain_pitch>(t, "drain_pitch", "--drain-pitch",
                                  {.unit = "mm",
                                   .limits = {0.001, 100},
                                   .fallback = "a third of the skin's thickness, at most 16 layers",
                                   .help = "Distance of the rows in which the survey for cavities looks."});
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
                          .help = "Where it is: the point of the surface that is nearest to this one."});
    add_hole_row<&H::radius>(
        t, "radius", {.unit = "mm", .limits = {0.01, 1e4}, .fallback = "required", .help = "Its radius."});
    add_hole_row<&H::direction>(t, "direction",
                                {.limits = place_limits,
                                 .fallback = "at right angles to the surface",
                                 .help = "Which way it is drilled, into the body."});
    add_hole_row<&H::depth>(t, "depth",
                            {.unit = "mm",
                             .limits = {0.001, 1e5},
                             .fallback = "through the skin",
                             .help = "How deep it is drilled, from the surface."});
    add_hole_row<&H::through>(
        t, "through", {.fallback = "false", .help = "Drilled through the filling, too, as deep as it goes."});
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
