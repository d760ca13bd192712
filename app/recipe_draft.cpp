// From assignments to a recipe: profile first, then the rest, and the rules that join several keys.
#include "app/recipe_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/printer_choice.h"
#include "engine/error.h"

namespace lamella {

namespace {

struct ShapeKeys {
    std::string shape;
    std::vector<std::string> keys;
};

const std::vector<ShapeKeys>& shape_keys() {
    static const std::vector<ShapeKeys> list{{"sphere", {"radius"}},
                                             {"box", {"size"}},
                                             {"cylinder", {"radius", "height"}},
                                             {"capsule", {"radius", "height"}},
                                             {"torus", {"radius", "tube"}},
                                             {"gyroid", {"size", "period", "thickness"}}};
    return list;
}

const std::vector<std::string> all_shape_keys{"radius", "size", "height", "tube", "period", "thickness"};

std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

}  // namespace

void RecipeDraft::set(const Setting& setting, Value value, std::string where, bool from_flag) {
    entries_[setting.name()] = {std::move(value), std::move(where), from_flag};
}

void RecipeDraft::assign_flag(const Setting& setting, const std::string& text) {
    std::string wrong;
    const auto value = parse_value(setting, text, wrong);
    if (!value) refuse(0, fmt::format("{}: {}; accepted: {}", setting.flag, wrong, accepted(setting)));
    entries_[setting.name()] = {value, setting.flag, true};
}

const RecipeDraft::Entry* RecipeDraft::entry(std::string_view section, std::string_view key) const {
    const auto found = entries_.find(std::string(section) + "." + std::string(key));
    return found == entries_.end() ? nullptr : &found->second;
}

bool RecipeDraft::section_used(const std::string& section) const {
    if (sections_.contains(section)) return true;
    return std::any_of(entries_.begin(), entries_.end(),
                       [&](const auto& e) { return e.first.starts_with(section + "."); });
}

/// A body given by a flag takes the place of the one in the recipe, whichever kind that was.
void RecipeDraft::drop_overridden_body() {
    const Entry* mesh = entry("part", "mesh");
    const Entry* shape = entry("part", "shape");
    if (!mesh || !shape || mesh->from_flag == shape->from_flag) return;
    if (shape->from_flag) {
        entries_.erase("part.mesh");
        return;
    }
    entries_.erase("part.shape");
    for (const std::string& key : all_shape_keys) {
        if (const Entry* size = entry("part", key); size && !size->from_flag) entries_.erase("part." + key);
    }
}

void RecipeDraft::check_required(const std::string& section, const std::string& key, const std::string& why) {
    if (entry(section, key)) return;
    const Setting& setting = *find_setting(section, key);
    const auto begin = sections_.find(section);
    const std::string where =
        begin == sections_.end() ? setting.flag : fmt::format("{}.{}", begin->second, key);
    refuse(0, fmt::format("{}: missing, {} needs it; accepted: {}", where, why, accepted(setting)));
}

void RecipeDraft::check_body() {
    const Entry* mesh = entry("part", "mesh");
    const Entry* shape = entry("part", "shape");
    const bool no_shape = !shape || (shape->value && std::get<std::string>(*shape->value) == "none");
    if (mesh && !no_shape && shape->value) {
        refuse(0, fmt::format("{}: contradicts {}; accepted: a mesh or a shape, not both", shape->where,
                              mesh->where));
        return;
    }
    if (!mesh && no_shape && body_required_) {
        const auto part = sections_.find("part");
        refuse(
            0,
            fmt::format(
                "{}: no body is given; accepted: a mesh file (part.mesh or MODEL), or part.shape / --shape",
                part == sections_.end() ? "part" : part->second));
    }
    if (shape && !shape->value) return;
    const std::string word = no_shape ? "none" : std::get<std::string>(*shape->value);
    std::vector<std::string> wanted;
    for (const ShapeKeys& keys : shape_keys()) {
        if (keys.shape == word) wanted = keys.keys;
    }
    for (const std::string& key : wanted) check_required("part", key, "shape " + word);
    for (const std::string& key : all_shape_keys) {
        const Entry* given = entry("part", key);
        if (!given || std::find(wanted.begin(), wanted.end(), key) != wanted.end()) continue;
        refuse(0, no_shape ? fmt::format("{}: only a shape has it; accepted: part.shape / --shape with it",
                                         given->where)
                           : fmt::format("{}: a {} does not have it; accepted: {}", given->where, word,
                                         listed(wanted)));
    }
}

void RecipeDraft::check_structure() {
    if (section_used("foam")) {
        check_required("foam", "cell", "foam");
        check_required("foam", "beam", "foam");
    }
    if (section_used("skin")) check_required("skin", "thickness", "a skin");
}

void RecipeDraft::check_printer() {
    const Entry* pixel = entry("printer", "pixel");
    for (const char* key : {"pixel_x", "pixel_y"}) {
        const Entry* one = entry("printer", key);
        if (!pixel || !one) continue;
        if (pixel->from_flag != one->from_flag) {
            entries_.erase(pixel->from_flag ? std::string("printer.") + key : "printer.pixel");
            pixel = entry("printer", "pixel");
        } else {
            refuse(0, fmt::format("{}: contradicts {}; accepted: pixel alone, or pixel_x and pixel_y",
                                  one->where, pixel->where));
        }
    }
}

Recipe RecipeDraft::assemble() const {
    Recipe recipe;
    recipe.printer = default_profile();
    if (const Entry* profile = entry("printer", "profile"); profile && profile->value) {
        recipe.printer = profile_named(std::get<std::string>(*profile->value));
    }
    for (const Setting& setting : settings()) {
        const Entry* given = entry(setting.section, setting.key);
        if (given && given->value && setting.name() != "printer.profile")
            setting.store(recipe, *given->value);
    }
    if (recipe.skin && recipe.skin->thickness == 0) recipe.skin.reset();
    if (recipe.part.name.empty()) {
        const std::string stem = std::filesystem::path(recipe.part.mesh).stem().string();
        const Setting& shape = *find_setting("part", "shape");
        recipe.part.name = recipe.part.mesh.empty() ? format_value(shape.load(recipe)) : stem;
    }
    return recipe;
}

/// Rules between numbers that are each fine on their own.
void RecipeDraft::check_numbers(const Recipe& recipe) {
    const auto where = [&](const char* section, const char* key) {
        const Entry* given = entry(section, key);
        return given ? given->where : std::string(section) + "." + key;
    };
    const PartRecipe& part = recipe.part;
    if (recipe.foam && recipe.foam->beam >= recipe.foam->cell / 2) {
        refuse(0, fmt::format("{}: {} mm fills cells of {} mm; accepted: less than half the cell, {} mm",
                              where("foam", "beam"), recipe.foam->beam, recipe.foam->cell,
                              recipe.foam->cell / 2));
    }
    if (part.shape == Shape::capsule && part.height < 2 * part.radius) {
        refuse(0, fmt::format(
                      "{}: {} mm is less than the two round ends of radius {} mm; accepted: {} mm or more",
                      where("part", "height"), part.height, part.radius, 2 * part.radius));
    }
    if (part.shape == Shape::torus && part.tube >= part.radius) {
        refuse(0, fmt::format(
                      "{}: {} mm closes the hole of a torus of radius {} mm; accepted: less than the radius",
                      where("part", "tube"), part.tube, part.radius));
    }
    if (part.shape == Shape::gyroid && part.thickness >= part.period / 2) {
        refuse(0, fmt::format("{}: {} mm fills a gyroid of period {} mm; accepted: less than half the period",
                              where("part", "thickness"), part.thickness, part.period));
    }
    if (part.name.find_first_of("/\\") != std::string::npos || part.name == "." || part.name == "..") {
        refuse(0, fmt::format("{}: \"{}\" cannot name a file; accepted: a text without / and \\",
                              where("part", "name"), part.name));
    }
}

Recipe RecipeDraft::finish() {
    drop_overridden_body();
    check_body();
    check_structure();
    check_printer();
    const bool single_values_fine = mistakes_.empty();
    Recipe recipe = assemble();
    if (single_values_fine) check_numbers(recipe);
    if (mistakes_.empty()) return recipe;
    std::stable_sort(mistakes_.begin(), mistakes_.end(), [](const Mistake& a, const Mistake& b) {
        return (a.line ? a.line : 1 << 30) < (b.line ? b.line : 1 << 30);
    });
    std::string text;
    for (const Mistake& mistake : mistakes_) text += (text.empty() ? "" : "\n") + mistake.text;
    throw InputError(text);
}

}  // namespace lamella
