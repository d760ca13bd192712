// From assignments to a recipe: profile first, then the rest, and the rules that join several keys.
#include "app/recipe_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "app/printer_choice.h"
#include "app/recipe_formulas.h"
#include "app/recipe_regions.h"
#include "app/settings_rows.h"
#include "engine/error.h"
#include "procedural/nearest_foam.h"
#include "procedural/tpms.h"

namespace lamella {

namespace {

/// The keys that name a body; one of them holds.
const std::vector<std::string> body_keys{"mesh", "shape", "field"};

std::string listed(const std::vector<std::string>& words, const char* between = ", ") {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

/// All keys that go with a kind, or with any kind of the section.
std::vector<std::string> keys_of(const Kind& kind) {
    std::vector<std::string> keys;
    for (const std::string& need : kind.needs) {
        for (std::string& key : alternatives(need)) keys.push_back(std::move(key));
    }
    keys.insert(keys.end(), kind.takes.begin(), kind.takes.end());
    return keys;
}

/// What every entry of a list section has.
std::vector<std::string> needs_of_list(std::string_view section) {
    if (section == "hole") return {"at", "radius"};
    if (section == "region") return {};
    return {"name"};
}

std::set<std::string> keys_of(const KindSection& section) {
    std::set<std::string> keys;
    for (const Kind& kind : section.kinds) {
        for (std::string& key : keys_of(kind)) keys.insert(std::move(key));
    }
    return keys;
}

}  // namespace

void RecipeDraft::set(const Setting& setting, std::size_t number, Value value, const std::string& where,
                      bool from_flag) {
    if (auto* graded = std::get_if<GradedNumber>(&value)) graded->where = where;
    if (auto* triple = std::get_if<GradedTriple>(&value)) {
        for (std::size_t i = 0; i < 3; ++i) (*triple)[i].where = fmt::format("{} ({})", where, "xyz"[i]);
    }
    entries_[{setting.section, number, setting.key}] = {std::move(value), where, from_flag};
}

void RecipeDraft::assign_flag(const Setting& setting, const std::string& text) {
    std::string wrong;
    const auto value = parse_value(setting, text, wrong);
    if (value) return set(setting, 0, *value, setting.flag, true);
    refuse(0, fmt::format("{}: {}; accepted: {}", setting.flag, wrong, accepted(setting)));
    entries_[{setting.section, 0, setting.key}] = {std::nullopt, setting.flag, true};
}

const RecipeDraft::Entry* RecipeDraft::entry(std::string_view section, std::string_view key,
                                             std::size_t number) const {
    const auto found = entries_.find({std::string(section), number, std::string(key)});
    return found == entries_.end() ? nullptr : &found->second;
}

/// Where a key stands, or where it would stand.
std::string RecipeDraft::where(std::string_view section, std::string_view key, std::size_t number) const {
    if (const Entry* given = entry(section, key, number); given && !given->where.empty()) return given->where;
    if (const auto begin = sections_.find({std::string(section), number}); begin != sections_.end()) {
        return fmt::format("{}.{}", begin->second, key);
    }
    const Setting* setting = find_setting(section, key);
    return setting && !setting->flag.empty() ? setting->flag : fmt::format("{}.{}", section, key);
}

std::size_t RecipeDraft::count(const Section& section) const {
    std::size_t most = 0;
    for (const auto& [part, begin] : sections_) {
        if (part.section == section.name) most = std::max(most, part.entry + 1);
    }
    for (const auto& [place, value] : entries_) {
        if (place.section == section.name) most = std::max(most, place.entry + 1);
    }
    return most;
}

/// A body given by a flag takes the place of the one in the recipe, whichever kind that was.
void RecipeDraft::drop_overridden_body() {
    const auto from_flag = [&](const std::string& key) {
        const Entry* given = entry("part", key);
        return given && given->from_flag;
    };
    if (std::none_of(body_keys.begin(), body_keys.end(), from_flag)) return;
    for (const std::string& key : body_keys) {
        if (!from_flag(key)) entries_.erase({"part", 0, key});
    }
    if (entry("part", "shape")) return;
    for (const KindSection& section : kind_sections()) {
        if (section.section != "part") continue;
        for (const std::string& key : keys_of(section)) {
            if (!from_flag(key)) entries_.erase({"part", 0, key});
        }
    }
}

/// Where a section or an entry of a list section begins.
std::string RecipeDraft::where_begins(const std::string& section, std::size_t number) const {
    const auto begin = sections_.find({section, number});
    return begin == sections_.end() ? section : begin->second;
}

void RecipeDraft::check_need(const Part& part, const std::string& need, const std::string& why) {
    const std::vector<std::string> keys = alternatives(need);
    std::vector<std::string> given;
    for (const std::string& key : keys) {
        if (entry(part.section, key, part.entry)) given.push_back(key);
    }
    const Setting& setting = *find_setting(part.section, keys.front());
    if (given.empty()) {
        const std::string other =
            keys.size() > 1 ? fmt::format(" (or {})", listed({keys.begin() + 1, keys.end()}, " or ")) : "";
        refuse(0, fmt::format("{}: missing, {} needs it{}; accepted: {}",
                              where(part.section, keys.front(), part.entry), why, other, accepted(setting)));
    } else if (given.size() > 1) {
        refuse(0, fmt::format("{}: contradicts {}; accepted: one of {}",
                              where(part.section, given[1], part.entry),
                              where(part.section, given[0], part.entry), listed(keys)));
    }
}

void RecipeDraft::check_kind(const KindSection& section, std::size_t number) {
    const Entry* chosen = entry(section.section, section.key, number);
    if (chosen && !chosen->value) return;
    if (!chosen && section.fallback.empty()) {
        return check_need({section.section, number}, section.key, "[[" + section.section + "]]");
    }
    const std::string word = chosen ? std::get<std::string>(*chosen->value) : section.fallback;
    const auto kind = std::find_if(section.kinds.begin(), section.kinds.end(),
                                   [&](const Kind& k) { return k.word == word; });
    const std::string why = section.key + " " + word;
    for (const std::string& need : kind->needs) check_need({section.section, number}, need, why);
    const std::vector<std::string> wanted = keys_of(*kind);
    for (const std::string& key : keys_of(section)) {
        const Entry* given = entry(section.section, key, number);
        if (!given || std::find(wanted.begin(), wanted.end(), key) != wanted.end()) continue;
        const bool no_shape = section.section == "part" && word == "none";
        refuse(0, no_shape ? fmt::format("{}: only a shape has it; accepted: part.shape / --shape with it",
                                         given->where)
                           : fmt::format("{}: {} does not have it; accepted: {}", given->where, why,
                                         listed(wanted)));
    }
}

/// Exactly one body, which may be the only [[field]]; false when there are several.
bool RecipeDraft::check_bodies() {
    std::vector<const Entry*> given;
    for (const std::string& key : body_keys) {
        const Entry* body = entry("part", key);
        if (body && !body->value) return true;
        if (body && !(key == "shape" && std::get<std::string>(*body->value) == "none")) given.push_back(body);
    }
    if (given.size() > 1) {
        refuse(0, fmt::format("{}: contradicts {}; accepted: a mesh, a shape or a field, one of them",
                              given[1]->where, given[0]->where));
        return false;
    }
    const std::size_t fields = count(*find_section("field"));
    if (!given.empty() || !body_required_ || fields == 1) return true;
    const std::string begin = where_begins("part", 0);
    refuse(0, fields == 0
                  ? fmt::format("{}: no body is given; accepted: a mesh file (part.mesh or MODEL), "
                                "part.shape / --shape, or a [[field]]",
                                begin)
                  : fmt::format("{}: no body is given; accepted: part.field / --field with the name of "
                                "one of the {} [[field]]",
                                begin, fields));
    return true;
}

void RecipeDraft::check_structure() {
    const bool one_body = check_bodies();
    for (const Section& section : sections()) {
        const std::size_t found = count(section);
        for (std::size_t number = 0; section.is_list() && number < found; ++number) {
            for (const std::string& key : needs_of_list(section.name))
                check_need({section.name, number}, key, section.title());
        }
        for (const KindSection& kinds : kind_sections()) {
            if (kinds.section != section.name || (section.name == "part" && !one_body)) continue;
            for (std::size_t number = 0; number < std::max<std::size_t>(found, section.name == "part");
                 ++number) {
                check_kind(kinds, number);
            }
        }
    }
    if (count(*find_section("skin")) > 0) check_need({"skin", 0}, "thickness", "a skin");
    if (count(*find_section("frame")) > 0) check_need({"frame", 0}, "beam", "a frame");
}

void RecipeDraft::check_printer() {
    const Entry* pixel = entry("printer", "pixel");
    for (const char* key : {"pixel_x", "pixel_y"}) {
        const Entry* one = entry("printer", key);
        if (!pixel || !one) continue;
        if (pixel->from_flag != one->from_flag) {
            entries_.erase({"printer", 0, pixel->from_flag ? std::string(key) : "pixel"});
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
    for (const auto& [place, given] : entries_) {
        const Setting& setting = *find_setting(place.section, place.key);
        if (given.value && setting.name() != "printer.profile") {
            setting.store(recipe, place.entry, *given.value);
        }
    }
    for (std::size_t i = 0; i < recipe.fields.size(); ++i) recipe.fields[i].where = where_begins("field", i);
    for (std::size_t i = 0; i < recipe.gradings.size(); ++i) {
        recipe.gradings[i].where = where_begins("grading", i);
    }
    for (std::size_t i = 0; i < recipe.regions.size(); ++i)
        recipe.regions[i].where = where_begins("region", i);
    for (std::size_t i = 0; i < recipe.holes.size(); ++i) recipe.holes[i].where = where_begins("hole", i);
    if (recipe.skin && recipe.skin->thickness == GradedNumber{}) recipe.skin.reset();
    const auto makes_skin = [](const RegionRecipe& region) { return region.make == RegionMake::skin; };
    if (std::any_of(recipe.regions.begin(), recipe.regions.end(), makes_skin) && !recipe.skin) {
        recipe.skin.emplace();
    }
    PartRecipe& part = recipe.part;
    if (part.mesh.empty() && part.shape == Shape::none && part.field.empty() && recipe.fields.size() == 1) {
        part.field = recipe.fields.front().name;
    }
    if (part.name.empty()) {
        const std::string shape = format_value(find_setting("part", "shape")->load(recipe, 0));
        const std::string stem = std::filesystem::path(part.mesh).stem().string();
        part.name = !part.mesh.empty() ? stem : !part.field.empty() ? part.field : shape;
    }
    return recipe;
}

/// Rules between what stretches a foam and its kind.
void RecipeDraft::check_stretch(const FoamRecipe& foam) {
    const auto stretch = constant(foam.stretch);
    if (entry("foam", "turn") && stretch == dvec3(1)) {
        refuse(0,
               fmt::format("{}: turns nothing where nothing is stretched; accepted: foam.stretch / --stretch "
                           "with it",
                           where("foam", "turn")));
    }
    if (foam.kind == "k-nearest") {
        for (const GradedNumber& factor : foam.stretch) {
            if (factor.is_formula() || nearest_factors.contains(factor.number())) continue;
            refuse(0, fmt::format("{}: {} is too {} for kind k-nearest; accepted: {} to {}",
                                  where("foam", "stretch"), factor.number(),
                                  factor.number() < nearest_factors.lo ? "small" : "large",
                                  nearest_factors.lo, nearest_factors.hi));
        }
        return;
    }
    for (const auto& [key, given] : {std::pair("stretch", stretch), std::pair("turn", constant(foam.turn))}) {
        if (given) continue;
        refuse(0, fmt::format("{}: kind {} has the same everywhere; accepted: three numbers, or formulas "
                              "for kind k-nearest",
                              where("foam", key), foam.kind));
    }
}

/// Rules between a number that may vary and its limits.
void RecipeDraft::check_limits(const std::string& section, const std::string& key, const GradedNumber& number,
                               double least, double most) {
    const std::string low = key + "_min", high = key + "_max";
    if (least > most) {
        refuse(0, fmt::format("{}: {} mm is more than {}, {} mm; accepted: the least first",
                              where(section, low), least, where(section, high), most));
    } else if (!number.is_formula() && (number.number() < least || number.number() > most)) {
        refuse(0,
               fmt::format("{}: {} mm lies outside {}.{} and {}.{}; accepted: {} to {} mm",
                           where(section, key), number.number(), section, low, section, high, least, most));
    }
}

/// Rules between the numbers of a foam.
void RecipeDraft::check_foam(const FoamRecipe& foam) {
    check_stretch(foam);
    check_limits("foam", "cell", foam.cell, foam.cell_min, foam.cell_max);
    if (entry("foam", "wall")) check_limits("foam", "wall", foam.wall, foam.wall_min, foam.wall_max);
    if (!entry("foam", "beam")) return;
    check_limits("foam", "beam", foam.beam, foam.beam_min, foam.beam_max);
    if (foam.cell.is_formula() || foam.beam.is_formula()) return;
    if (foam.beam.number() >= foam.cell.number() / 2) {
        refuse(0, fmt::format("{}: {} mm fills cells of {} mm; accepted: less than half the cell, {} mm",
                              where("foam", "beam"), foam.beam.number(), foam.cell.number(),
                              foam.cell.number() / 2));
    }
}

void RecipeDraft::check_frame(const Recipe& recipe) {
    const FrameRecipe& frame = *recipe.frame;
    const std::vector<std::string> with_faces{"voronoi", "kelvin", "closed"};
    const bool follows =
        recipe.foam && std::find(with_faces.begin(), with_faces.end(), recipe.foam->kind) != with_faces.end();
    if (!follows) {
        refuse(0, fmt::format("{}: a frame follows the faces of a foam's cells, and {}; accepted: foam.kind "
                              "{} with it",
                              where("frame", "beam"),
                              recipe.foam ? "kind " + recipe.foam->kind + " has none" : "there is no foam",
                              fmt::join(with_faces, ", ")));
    }
    check_limits("frame", "beam", frame.beam, frame.beam_min, frame.beam_max);
}

void RecipeDraft::check_output(const OutputRecipe& output) {
    if (output.beams.empty()) {
        if (output.beams_box.empty()) return;
        return refuse(0, fmt::format("{}: there is no file for the beams in it; accepted: output.beams / "
                                     "--output-beams with it",
                                     where("output", "beams_box")));
    }
    if (!output.beams.ends_with(".3mf")) {
        refuse(0, fmt::format("{}: \"{}\" is no 3MF file's name; accepted: a path that ends in .3mf",
                              where("output", "beams"), output.beams));
    }
    if (!output.beams_box.empty() && box_of(output.beams_box).empty()) {
        refuse(0, fmt::format("{}: a lower corner lies above the upper one; accepted: the lower corner first",
                              where("output", "beams_box")));
    }
}

/// A skin with windows or holes lies inside.
void RecipeDraft::check_cut_skin(const Recipe& recipe) {
    const SkinRecipe& skin = *recipe.skin;
    if (skin.side == SkinSide::inside) return;
    if (skin.pattern == "closed" && recipe.holes.empty() && skin.drains == 0) return;
    refuse(0, fmt::format("{}: a skin with windows, holes or drains lies inside the body; accepted: inside",
                          where("skin", "side")));
}

/// Rules between drains, their keys and the foam.
void RecipeDraft::check_drains(const Recipe& recipe) {
    if (recipe.skin->drains == 0) {
        for (const char* key : {"drain_radius", "drain_pitch"}) {
            if (!entry("skin", key)) continue;
            refuse(0, fmt::format("{}: there are no drains; accepted: skin.drains / --drains with it",
                                  where("skin", key)));
        }
    } else if (recipe.foam && recipe.foam->kind == "closed" && !recipe.foam->window.is_formula() &&
               recipe.foam->window.number() == 0) {
        refuse(0, fmt::format("{}: each cell of a closed foam is a cavity of its own, too many to drain; "
                              "accepted: a foam of open cells, foam.window / --window above 0, or no drains",
                              where("skin", "drains")));
    }
}

/// Rules between the sizes of the part's shape, or of a field's.
template <typename Sizes>
void RecipeDraft::check_shape(const Part& of, const std::string& shape, const Sizes& sizes) {
    if (shape == "capsule" && sizes.height < 2 * sizes.radius) {
        refuse(0, fmt::format(
                      "{}: {} mm is less than the two round ends of radius {} mm; accepted: {} mm or more",
                      where(of.section, "height", of.entry), sizes.height, sizes.radius, 2 * sizes.radius));
    }
    if (shape == "torus" && sizes.tube >= sizes.radius) {
        refuse(0, fmt::format(
                      "{}: {} mm closes the hole of a torus of radius {} mm; accepted: less than the radius",
                      where(of.section, "tube", of.entry), sizes.tube, sizes.radius));
    }
}

/// Rules between numbers that are each fine on their own.
void RecipeDraft::check_numbers(const Recipe& recipe) {
    const PartRecipe& part = recipe.part;
    if (recipe.foam) check_foam(*recipe.foam);
    if (recipe.frame) check_frame(recipe);
    check_output(recipe.output);
    if (const auto& skin = recipe.skin) {
        check_limits("skin", "thickness", skin->thickness, skin->thickness_min, skin->thickness_max);
        check_drains(recipe);
        check_cut_skin(recipe);
    } else if (!recipe.holes.empty()) {
        refuse(0, fmt::format("{}: there is no skin to drill; accepted: [skin] with a thickness above 0",
                              recipe.holes.front().where));
    }
    if (const Entry* layers = entry("process", "elephant_foot_layers");
        layers && recipe.process->elephant_foot == 0) {
        refuse(0, fmt::format("{}: no layer is drawn in; accepted: process.elephant_foot / --elephant-foot "
                              "above 0 with it",
                              layers->where));
    }
    check_shape({"part", 0}, words(part.shape)[static_cast<std::size_t>(part.shape)], part);
    for (std::size_t i = 0; i < recipe.fields.size(); ++i) {
        check_shape({"field", i}, recipe.fields[i].kind, recipe.fields[i]);
    }
    const double thickest = greatest_tpms_thickness(TpmsKind::gyroid, false) * part.period;
    if (part.shape == Shape::gyroid && part.thickness >= thickest) {
        refuse(0, fmt::format("{}: {} mm fills a gyroid of period {} mm; accepted: less than {:.4g} mm",
                              where("part", "thickness"), part.thickness, part.period, thickest));
    }
    if (part.name.find_first_of("/\\") != std::string::npos || part.name == "." || part.name == "..") {
        refuse(0, fmt::format("{}: \"{}\" cannot name a file; accepted: a text without / and \\",
                              where("part", "name"), part.name));
    }
}

Recipe RecipeDraft::finish() {
    drop_overridden_body();
    check_structure();
    check_printer();
    const bool single_values_fine = mistakes_.empty();
    Recipe recipe = assemble();
    if (single_values_fine) {
        check_numbers(recipe);
        for (std::string& mistake : formula_mistakes(recipe)) refuse(0, std::move(mistake));
        for (std::string& mistake : region_mistakes(recipe)) refuse(0, std::move(mistake));
    }
    if (mistakes_.empty()) return recipe;
    std::stable_sort(mistakes_.begin(), mistakes_.end(), [](const Mistake& a, const Mistake& b) {
        return (a.line ? a.line : 1 << 30) < (b.line ? b.line : 1 << 30);
    });
    std::string text;
    for (const Mistake& mistake : mistakes_) text += (text.empty() ? "" : "\n") + mistake.text;
    throw InputError(text);
}

}  // namespace lamella
