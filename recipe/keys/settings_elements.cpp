// The rows of the settings table about discrete elements: their shapes, and how they are placed.
#include "recipe/keys/settings_rows.h"

namespace lamella {

const std::vector<std::string>& choice_names(ElementKind) {
    static const std::vector<std::string> list{"stick", "ring", "outline", "field"};
    return list;
}

namespace {

template <auto member>
void add_element_length(std::vector<Setting>& t, const char* key, const char* needed_by, const char* help) {
    t.push_back(
        list_row<&Recipe::element_shapes, member>("element", key,
                                                  {.unit = "mm",
                                                   .limits = extent_limits,
                                                   .fallback = std::string("required by ") + needed_by,
                                                   .help = help}));
}

template <auto member>
void add_elements_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    t.push_back(optional_row<&Recipe::elements, member>("elements", key, flag, std::move(facts)));
}

using Placing = ElementsRecipe;

void add_element_aims(std::vector<Setting>& t) {
    add_elements_row<&Placing::count>(t, "count", "--elements-count",
                                      {.limits = {1, 1'000'000},
                                       .fallback = format_value(std::int64_t{Placing{}.count}),
                                       .help = "Number of copies."});
    add_elements_row<&Placing::scale_min>(
        t, "scale_min", "--elements-scale-min",
        {.limits = {0.01, 100}, .fallback = "1", .help = "Smallest scale of a copy."});
    add_elements_row<&Placing::scale_max>(
        t, "scale_max", "--elements-scale-max",
        {.limits = {0.01, 100}, .fallback = "1", .help = "Largest scale of a copy."});
    add_elements_row<&Placing::overlap>(
        t, "overlap", "--elements-overlap",
        {.limits = {0.01, 0.9},
         .fallback = format_value(Placing{}.overlap),
         .help = "Largest share of the copies' volume that lies within others or outside the "
                 "part. Copies have to touch, so it is not 0."});
    add_elements_row<&Placing::turns>(
        t, "turns", "--elements-turns",
        {.fallback = "true",
         .help = "Whether copies turn, or stay as their shapes are given, or along a direction."});
    add_elements_row<&Placing::along>(
        t, "along", "--elements-along",
        {.limits = {-1e6, 1e6},
         .fallback = "any",
         .help = "Direction of the copies' x axis, of any length; on a skin as far as the surface allows."});
    add_elements_row<&Placing::density>(
        t, "density", "--elements-density",
        {.limits = {0, 1e6},
         .fallback = "1",
         .help = "Where no loads place copies: how many there are, relative to elsewhere; 0: none."});
    add_elements_row<&Placing::example>(
        t, "example", "--elements-example",
        {.fallback = "none",
         .help =
             "Where no loads place copies: CSV file of copies, as `lamella dump elements` writes it, whose "
             "shapes, scales, turns and evenness of spacing they take; relative to the recipe's folder.",
         .is_path = true});
    add_elements_row<&Placing::seed>(
        t, "seed", "--elements-seed",
        {.limits = {0, 9007199254740992}, .fallback = "1", .help = "Seed of the places where copies begin."});
}

void add_element_search(std::vector<Setting>& t) {
    add_elements_row<&Placing::element>(t, "element", "--elements-element",
                                        {.unit = "mm",
                                         .limits = {0, 1000},
                                         .fallback = "a third of the thinnest shape",
                                         .help = "Edge of the finite elements."});
    add_elements_row<&Placing::dimensions>(
        t, "dimensions", "--elements-dimensions",
        {.limits = {2, 3},
         .fallback = "3",
         .help = "2: a plate in the xy plane: copies are as high as the part, move in the "
                 "plane and turn about z."});
    add_elements_row<&Placing::iterations>(t, "iterations", "--elements-iterations",
                                           {.limits = {1, 10000},
                                            .fallback = format_value(std::int64_t{Placing{}.iterations}),
                                            .help = "Number of steps of the search."});
    add_elements_row<&Placing::reach>(
        t, "reach", "--elements-reach",
        {.unit = "mm",
         .limits = {0, 1000},
         .fallback = "the thickness of the thinnest shape",
         .help = "Widest gap over which a loose copy is moved or bridged to the others; beyond, it is "
                 "dropped."});
    add_elements_row<&Placing::bridge>(
        t, "bridge", "--elements-bridge",
        {.unit = "mm",
         .limits = {0, 1000},
         .fallback = "0",
         .help = "Width of bridges that join loose copies to the others; 0: copies are moved instead."});
}

}  // namespace

void add_element_settings(std::vector<Setting>& t) {
    t.push_back(list_row<&Recipe::element_shapes, &ElementRecipe::kind>(
        "element", "kind", {.fallback = "stick", .help = "Kind of the shape."}));
    add_element_length<&ElementRecipe::length>(
        t, "length", "stick; outlines are as large as they are given",
        "Length of a stick with round ends, in all, or of the longer side of an outline.");
    add_element_length<&ElementRecipe::diameter>(t, "diameter", "ring", "Outer diameter of a ring.");
    add_element_length<&ElementRecipe::width>(t, "width", "stick, ring",
                                              "Thickness of a stick or of a ring's tube.");
    t.push_back(list_row<&Recipe::element_shapes, &ElementRecipe::corners>(
        "element", "corners",
        {.unit = "mm",
         .limits = place_limits,
         .shape = {2, 0, "points [[x, y], ...]"},
         .fallback = "an outline has corners or a file",
         .help = "Corners of a closed outline about the copy's middle; the last is joined to the first."}));
    t.push_back(list_row<&Recipe::element_shapes, &ElementRecipe::file>(
        "element", "file",
        {.fallback = "an outline has corners or a file",
         .help = "SVG drawing whose filled shapes are the outline, relative to the recipe's folder.",
         .is_path = true}));
    add_element_length<&ElementRecipe::thickness>(
        t, "thickness", "outline in space",
        "Thickness of an outline; in two dimensions that of the part, on a skin that of the skin.");
    t.push_back(list_row<&Recipe::element_shapes, &ElementRecipe::field>(
        "element", "field",
        {.fallback = "required by field",
         .help = "Name of a [[field]] that is the shape; its origin is the copy's middle."}));
}

void add_elements_settings(std::vector<Setting>& t) {
    add_element_aims(t);
    add_element_search(t);
}

}  // namespace lamella
