// The rows of the settings table about structural optimisation: loads, anchors, and what is optimised.
#include "recipe/keys/settings_rows.h"

namespace lamella {

const std::vector<std::string>& choice_names(OptimizeKind) {
    static const std::vector<std::string> list{"stiffness", "lightness", "appearance"};
    return list;
}
const std::vector<std::string>& choice_names(OptimizeResult) {
    static const std::vector<std::string> list{"solid", "cell", "beam", "field"};
    return list;
}
const std::vector<std::string>& choice_names(OptimizeMethod) {
    static const std::vector<std::string> list{"oc", "mma"};
    return list;
}

namespace {

using O = OptimizeRecipe;
constexpr const char* one_place = "a place is a field, a box, at and normal, or a face";

/// The rows of a place, which loads and anchors share.
template <auto list>
void add_place(std::vector<Setting>& t, const char* section) {
    using Entry = typename std::remove_reference_t<decltype(std::declval<Recipe&>().*list)>::value_type;
    t.push_back(list_row<list, &Entry::field>(
        section, "field",
        {.fallback = one_place, .help = "Name of a [[field]]: what of the body lies inside it."}));
    t.push_back(list_row<list, &Entry::box>(section, "box",
                                            {.unit = "mm",
                                             .limits = place_limits,
                                             .shape = {3, 2, "two corners [[x, y, z], [x, y, z]]"},
                                             .fallback = one_place,
                                             .help = "What of the body lies inside this box."}));
    t.push_back(list_row<list, &Entry::at>(section, "at",
                                           {.unit = "mm",
                                            .limits = place_limits,
                                            .fallback = one_place,
                                            .help = "A point of a plane: what of the body lies beyond it."}));
    t.push_back(list_row<list, &Entry::normal>(
        section, "normal",
        {.limits = place_limits,
         .fallback = "required by at",
         .help = "Direction from the plane to the side on which the place lies, of any length."}));
    t.push_back(list_row<list, &Entry::face>(
        section, "face",
        {.choices = {"-x", "+x", "-y", "+y", "-z", "+z"},
         .fallback = one_place,
         .help = "The outermost layer of the body's elements in this direction."}));
}

template <auto member>
void add_optimize_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    t.push_back(optional_row<&Recipe::optimize, member>("optimize", key, flag, std::move(facts)));
}

void add_aims(std::vector<Setting>& t) {
    add_optimize_row<&O::kind>(
        t, "kind", "--optimize-kind",
        {.fallback = "stiffness",
         .help = "What is sought: stiffness is the least compliance at a bounded volume; "
                 "lightness is the least volume, and appearance looks like a picture, both at a "
                 "bounded compliance."});
    add_optimize_row<&O::result>(
        t, "result", "--optimize-result",
        {.fallback = "solid",
         .help = "What varies in the part: solid is material or void; cell and beam are that "
                 "number of the foam; field leaves the part to fields and gradings of kind "
                 "optimized."});
    add_optimize_row<&O::volume>(t, "volume", "--optimize-volume",
                                 {.limits = {0.001, O::whole_part},
                                  .fallback = format_value(O{}.volume) + ", for lightness the whole part",
                                  .help = "Largest volume of the result, as a share of the part's."});
    add_optimize_row<&O::volume_min>(t, "volume_min", "--optimize-volume-min",
                                     {.limits = {0, 0.999},
                                      .fallback = "0",
                                      .help = "Smallest volume of the result, as a share of the part's."});
    add_optimize_row<&O::mass>(
        t, "mass", "--optimize-mass",
        {.unit = "g",
         .limits = {1e-6, 1e9},
         .fallback = "volume holds",
         .help = "Largest mass of the result, instead of volume. Needs the material's density."});
    add_optimize_row<&O::compliance>(
        t, "compliance", "--optimize-compliance",
        {.limits = {1, 1000},
         .fallback = format_value(O{}.compliance) + ", required by lightness",
         .help = "Largest compliance of the result: for lightness as a multiple of the full "
                 "part's, for appearance of the least one."});
}

void add_elements(std::vector<Setting>& t) {
    add_optimize_row<&O::element>(t, "element", "--optimize-element",
                                  {.unit = "mm",
                                   .limits = {0, 1000},
                                   .fallback = "follows from elements",
                                   .help = "Edge of the finite elements."});
    add_optimize_row<&O::elements>(t, "elements", "--optimize-elements",
                                   {.limits = {8, 2048},
                                    .fallback = "64, with two dimensions 200",
                                    .help = "Number of finite elements along the part's longest side."});
    add_optimize_row<&O::dimensions>(
        t, "dimensions", "--optimize-dimensions",
        {.limits = {2, 3},
         .fallback = "3, for appearance 2",
         .help = "2: a plate in the xy plane, as thick as the part is high; the result "
                 "is the same at every height."});
}

void add_limits_of_shape(std::vector<Setting>& t) {
    const auto length = [&]<auto member>(const char* key, const char* flag, const char* fallback,
                                         const char* help) {
        add_optimize_row<member>(t, key, flag,
                                 {.unit = "mm", .limits = {0, 1000}, .fallback = fallback, .help = help});
    };
    length.operator()<&O::radius>("radius", "--optimize-radius", "1.5 elements",
                                  "Radius over which densities are averaged (density filter).");
    length.operator()<&O::member>("member", "--optimize-member", "0, any",
                                  "Smallest thickness of members (robust formulation).");
    length.operator()<&O::gap>("gap", "--optimize-gap", "0, any",
                               "Smallest width of gaps between members (robust formulation).");
    add_optimize_row<&O::overhang>(
        t, "overhang", "--optimize-overhang",
        {.fallback = "false", .help = "Let each layer of elements rest on the one below it, at 45 degrees."});
    add_optimize_row<&O::symmetry>(
        t, "symmetry", "--optimize-symmetry",
        {.fallback = "none",
         .help = "Axes across which the result is mirrored by planes through the part's "
                 "middle: letters such as \"xy\"."});
    add_optimize_row<&O::gravity>(
        t, "gravity", "--optimize-gravity",
        {.unit = "m/s2",
         .limits = {-1e6, 1e6},
         .fallback = "0, 0, 0",
         .help = "Acceleration that gives the result its own weight, such as 0, 0, -9.81. "
                 "Needs the material's density."});
}

void add_solver(std::vector<Setting>& t) {
    add_optimize_row<&O::iterations>(
        t, "iterations", "--optimize-iterations",
        {.limits = {1, 10000},
         .fallback = "100, for appearance 40",
         .help = "Largest number of steps; for appearance on the coarsest grid, half as "
                 "many on each finer one."});
    add_optimize_row<&O::tolerance>(t, "tolerance", "--optimize-tolerance",
                                    {.limits = {0, 1},
                                     .fallback = format_value(O{}.tolerance),
                                     .help = "Largest change of a density in a step at which it stops."});
    add_optimize_row<&O::penalty>(
        t, "penalty", "--optimize-penalty",
        {.limits = {1, 10},
         .fallback = format_value(O{}.penalty),
         .help = "Exponent of the modulus over the density: higher ones avoid grey (SIMP)."});
    add_optimize_row<&O::sharpness>(
        t, "sharpness", "--optimize-sharpness",
        {.limits = {0, 64},
         .fallback = format_value(O{}.sharpness),
         .help = "Sharpness of the projection of densities to 0 and 1 at the end; 0 for "
                 "no projection."});
    add_optimize_row<&O::method>(
        t, "method", "--optimize-method",
        {.fallback = "oc, for appearance mma",
         .help = "How densities are updated: oc is optimality criteria, mma the method of "
                 "moving asymptotes."});
}

void add_appearance(std::vector<Setting>& t) {
    add_optimize_row<&O::image>(
        t, "image", "--optimize-image",
        {.fallback = "required by appearance",
         .help = "Picture that the result looks like, material where it is dark; in a recipe, "
                 "relative to the recipe's folder.",
         .is_path = true});
    add_optimize_row<&O::image_size>(t, "image_size", "--optimize-image-size",
                                     {.unit = "mm",
                                      .limits = {0.01, 1e5},
                                      .fallback = "required by appearance",
                                      .help = "Length that the picture's width covers."});
    add_optimize_row<&O::invert>(
        t, "invert", "--optimize-invert",
        {.fallback = "false", .help = "Put material where the picture is bright instead of dark."});
    add_optimize_row<&O::threshold>(
        t, "threshold", "--optimize-threshold",
        {.limits = {0.001, 1},
         .fallback = "parts the picture's histogram best",
         .help = "Brightness from which the picture is bright, 0 is black and 1 white."});
    add_optimize_row<&O::neighbourhood>(
        t, "neighbourhood", "--optimize-neighbourhood",
        {.unit = "elements",
         .limits = {4, 64},
         .fallback = format_value(std::int64_t{O{}.neighbourhood}),
         .help = "Edge of the squares in which result and picture are compared."});
    add_optimize_row<&O::exponent>(t, "exponent", "--optimize-exponent",
                                   {.limits = {1, 2},
                                    .fallback = format_value(O{}.exponent),
                                    .help = "Exponent of the difference between result and picture."});
    add_optimize_row<&O::spread>(
        t, "spread", "--optimize-spread",
        {.limits = {0, 1e6},
         .fallback = format_value(O{}.spread),
         .help = "Weight with which all of the picture is used evenly; 0 for none."});
    add_optimize_row<&O::levels>(t, "levels", "--optimize-levels",
                                 {.limits = {1, 6},
                                  .fallback = format_value(std::int64_t{O{}.levels}),
                                  .help = "Number of grids, each twice as fine as the one before."});
}

}  // namespace

void add_load_settings(std::vector<Setting>& t) {
    add_place<&Recipe::loads>(t, "load");
    const auto add = [&]<auto member>(const char* key, SettingSpec facts) {
        t.push_back(list_row<&Recipe::loads, member>("load", key, std::move(facts)));
    };
    add.operator()<&LoadRecipe::force>("force", {.unit = "N",
                                                 .limits = {-1e9, 1e9},
                                                 .fallback = "a load has a force or a pressure",
                                                 .help = "Total force, spread evenly over the place."});
    add.operator()<&LoadRecipe::pressure>(
        "pressure", {.unit = "MPa",
                     .limits = {1e-9, 1e6},
                     .fallback = "a load has a force or a pressure",
                     .help = "Pressure on the body's surface in the place, inward along its normal."});
    add.operator()<&LoadRecipe::load_case>(
        "case", {.fallback = LoadRecipe{}.load_case,
                 .help = "Name of the load case: loads of one case act together, cases one after another."});
    add.operator()<&LoadRecipe::weight>("weight",
                                        {.limits = {1e-6, 1e6},
                                         .fallback = "1",
                                         .help = "Weight of the load case in the sum of compliances; one for "
                                                 "all loads of a case."});
}

void add_anchor_settings(std::vector<Setting>& t) {
    add_place<&Recipe::anchors>(t, "anchor");
    t.push_back(list_row<&Recipe::anchors, &AnchorRecipe::fix>(
        "anchor", "fix",
        {.fallback = AnchorRecipe{}.fix,
         .help = "Axes along which the place cannot move: letters such as \"xz\"."}));
}

void add_optimize_settings(std::vector<Setting>& t) {
    add_aims(t);
    add_elements(t);
    add_limits_of_shape(t);
    add_solver(t);
    add_appearance(t);
}

}  // namespace lamella
