// The list of kinds: shapes are defined here, the others by their builders.
#include "recipe/recipe_kinds.h"

#include "recipe/build/build_fields.h"
#include "recipe/build/build_foam.h"
#include "recipe/build/build_gradings.h"
#include "recipe/build/build_skin.h"

namespace lamella {

namespace {

template <typename Builders>
std::vector<Kind> keys_of(const Builders& builders) {
    std::vector<Kind> kinds;
    for (const auto& builder : builders) kinds.push_back(builder.kind);
    return kinds;
}

}  // namespace

const std::vector<KindSection>& kind_sections() {
    static const std::vector<KindSection> list{
        {"part",
         "shape",
         "none",
         {{"none", {}, {}},
          {"sphere", {"radius"}, {}},
          {"box", {"size"}, {}},
          {"cylinder", {"radius", "height"}, {}},
          {"capsule", {"radius", "height"}, {}},
          {"torus", {"radius", "tube"}, {}},
          {"gyroid", {"size", "period", "thickness"}, {}}}},
        {"field", "kind", "formula", keys_of(field_builders())},
        {"grading", "kind", "", keys_of(grading_builders())},
        {"region",
         "make",
         "",
         {{"solid", {"field"}, {"blend", "tool", "layer_height"}},
          {"empty", {"field"}, {"blend"}},
          {"foam", {"field"}, {"blend", "cell", "beam", "wall", "window", "modulus", "tool", "layer_height"}},
          {"skin", {"field", "thickness"}, {"blend", "tool", "layer_height"}},
          {"blocker", {"field"}, {}},
          {"enforcer", {"field"}, {}},
          {"tool", {"field", "tool"}, {"layer_height"}},
          {"layers", {"field", "layer_height"}, {}}}},
        {"optimize",
         "kind",
         "stiffness",
         {{"stiffness", {}, {}},
          {"lightness", {"compliance"}, {}},
          {"appearance",
           {"image", "image_size"},
           {"volume_min", "compliance", "invert", "threshold", "neighbourhood", "exponent", "spread",
            "levels"}}}},
        {"element",
         "kind",
         "stick",
         {{"stick", {"length", "width"}, {}},
          {"ring", {"diameter", "width"}, {}},
          {"outline", {"corners|file"}, {"length", "thickness"}},
          {"field", {"field"}, {}}}},
        {"foam", "kind", "voronoi", keys_of(foam_builders())},
        {"skin", "pattern", "closed", keys_of(pattern_builders())}};
    return list;
}

std::vector<std::string> kind_words(std::string_view section) {
    std::vector<std::string> words;
    for (const KindSection& known : kind_sections()) {
        if (known.section != section) continue;
        for (const Kind& kind : known.kinds) words.push_back(kind.word);
    }
    return words;
}

std::vector<std::string> alternatives(const std::string& need) {
    std::vector<std::string> keys;
    std::size_t begin = 0;
    for (std::size_t bar = 0; bar != std::string::npos; begin = bar + 1) {
        bar = need.find('|', begin);
        keys.push_back(need.substr(begin, bar - begin));
    }
    return keys;
}

}  // namespace lamella
