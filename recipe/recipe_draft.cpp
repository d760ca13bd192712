// Turns assignments into a recipe: profile first, then the rest, then the rules that relate several keys.
#include "recipe/recipe_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "engine/base/error.h"
#include "recipe/keys/settings_rows.h"
#include "recipe/recipe_formulas.h"
#include "recipe/recipe_regions.h"

namespace lamella {

namespace {

/// The keys that name a body; exactly one is used.
const std::vector<std::string> body_keys{"mesh", "shape", "field"};

std::string listed(const std::vector<std::string>& words, const char* between = ", ") {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

/// Returns the keys that apply to a kind, or to all kinds of the section.
std::vector<std::string> keys_of(const Kind& kind) {
    std::vector<std::string> keys;
    for (const std::string& need : kind.needs) {
        for (std::string& key : alternatives(need)) keys.push_back(std::move(key));
    }
    keys.insert(keys.end(), kind.takes.begin(), kind.takes.end());
    return keys;
}

/// Keys of every entry of a list section.
std::vector<std::string> needs_of_list(std::string_view section) {
    if (section == "hole") return {"at", "radius"};
    if (section == "load") return {"force|pressure"};
    if (section == "region" || section == "anchor" || section == "element" || section == "cut") return {};
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

void RecipeDraft::assign_flag(const Setting& setting, const std::string& text, const std::string& where) {
    std::string wrong;
    const auto value = parse_value(setting, text, wrong);
    if (value) return set(setting, 0, *value, where, true);
    refuse(0, fmt::format("{}: {}; accepted: {}", where, wrong, accepted(setting)));
    entries_[{setting.section, 0, setting.key}] = {std::nullopt, where, true};
}

void RecipeDraft::declare_host(const std::string& section, const std::string& name) {
    const std::size_t found = count(*find_section(section));
    for (std::size_t number = 0; number < found; ++number) {
        const Entry* given = entry(section, "name", number);
        if (given && given->value && std::get<std::string>(*given->value) == name) return;
    }
    const std::string where = fmt::format("[[{}]] of the program, {}", section, name);
    sections_[{section, found}] = where;
    set(*find_setting(section, "name"), found, name, where, false);
    set(*find_setting(section, "kind"), found, std::string(host_kind), where, false);
}

void RecipeDraft::give_field(const std::string& name, HostGiven<FieldPtr> field) {
    declare_host("field", name);
    host_fields_[name] = std::move(field);
}

void RecipeDraft::give_grading(const std::string& name, HostGiven<GradingPtr> grading) {
    declare_host("grading", name);
    host_gradings_[name] = std::move(grading);
}

/// Gives the entries of kind host the program's objects.
template <typename Entries, typename Given>
void RecipeDraft::hand_over(const std::string& section, Entries& entries, const Given& given) {
    for (auto& entry : entries) {
        const auto found = given.find(entry.name);
        const bool asks = entry.kind == host_kind, is_given = found != given.end();
        if (asks && is_given) entry.host = found->second;
        if (asks == is_given) continue;
        refuse(0, asks ? fmt::format("{}: kind {}: the embedding program does not provide the {} `{}`; "
                                     "accepted: another kind, or a program that provides it",
                                     entry.where, host_kind, section, entry.name)
                       : fmt::format(
                             "{}: kind {}: the embedding program also provides a {} `{}`; accepted: kind {}",
                             entry.where, entry.kind, section, entry.name, host_kind));
    }
}

const RecipeDraft::Entry* RecipeDraft::entry(std::string_view section, std::string_view key,
                                             std::size_t number) const {
    const auto found = entries_.find({std::string(section), number, std::string(key)});
    return found == entries_.end() ? nullptr : &found->second;
}

/// Returns the place of a key, or where it would be written.
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

/// A body given by a flag replaces the recipe's, whatever its kind.
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

/// Returns the place where a section or an entry of a list section begins.
std::string RecipeDraft::where_begins(const std::string& section, std::size_t number) const {
    const auto begin = sections_.find({section, number});
    return begin == sections_.end() ? section : begin->second;
}

void RecipeDraft::check_need(const Part& part, const std::string& need, const std::string& why) {
    const std::vector<std::string> keys = alternatives(need);
    const auto is_given = [&](const std::string& key) {
        return entry(part.section, key, part.entry) != nullptr;
    };
    if (std::none_of(keys.begin(), keys.end(), is_given)) {
        const Setting& setting = *find_setting(part.section, keys.front());
        const std::string other =
            keys.size() > 1 ? fmt::format(" (or {})", listed({keys.begin() + 1, keys.end()}, " or ")) : "";
        refuse(0, fmt::format("{}: missing, required by {}{}; accepted: {}",
                              where(part.section, keys.front(), part.entry), why, other, accepted(setting)));
    }
    check_at_most_one(part, keys);
}

void RecipeDraft::check_at_most_one(const Part& part, const std::vector<std::string>& keys) {
    std::vector<std::string> given;
    for (const std::string& key : keys) {
        if (entry(part.section, key, part.entry)) given.push_back(key);
    }
    if (given.size() < 2) return;
    refuse(0, fmt::format("{}: conflicts with {}; accepted: only one of {}",
                          where(part.section, given[1], part.entry),
                          where(part.section, given[0], part.entry), listed(keys)));
}

/// Returns true if a foam's modulus determines its cells or its members.
bool RecipeDraft::is_chosen_for_modulus(const KindSection& section, const std::string& need) const {
    return section.section == "foam" && entry("foam", "modulus") != nullptr &&
           (need == "cell" || need == "beam" || need == "wall");
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
    for (const std::string& need : kind->needs) {
        if (!is_chosen_for_modulus(section, need)) check_need({section.section, number}, need, why);
    }
    const std::vector<std::string> wanted = keys_of(*kind);
    for (const std::string& key : keys_of(section)) {
        const Entry* given = entry(section.section, key, number);
        // A misspelt key stands for the nearest one, without a place: it has been told already.
        if (!given || given->where.empty()) continue;
        if (std::find(wanted.begin(), wanted.end(), key) != wanted.end()) continue;
        std::string right = listed(wanted);
        if (wanted.empty()) {  // the kind has no key of its own: those that have this one are told
            for (const Kind& other : section.kinds) {
                const std::vector<std::string> its = keys_of(other);
                if (std::find(its.begin(), its.end(), key) == its.end()) continue;
                right += (right.empty() ? section.key + " " : ", ") + other.word;
            }
        }
        const bool no_shape = section.section == "part" && word == "none";
        refuse(0,
               no_shape
                   ? fmt::format(
                         "{}: applies only to a shape; accepted: this key together with part.shape / --shape",
                         given->where)
                   : fmt::format("{}: does not apply to {}; accepted: {}", given->where, why, right));
    }
}

/// Checks that there is exactly one body, which may be the only [[field]]. Returns false when there are
/// several.
bool RecipeDraft::check_bodies() {
    std::vector<const Entry*> given;
    for (const std::string& key : body_keys) {
        const Entry* body = entry("part", key);
        if (body && !body->value) return true;
        if (body && !(key == "shape" && std::get<std::string>(*body->value) == "none")) given.push_back(body);
    }
    if (given.size() > 1) {
        refuse(0, fmt::format("{}: conflicts with {}; accepted: only one of a mesh, a shape and a field",
                              given[1]->where, given[0]->where));
        return false;
    }
    const std::size_t fields = count(*find_section("field"));
    if (!given.empty() || !body_required_ || fields == 1) return true;
    const std::string begin = where_begins("part", 0);
    refuse(0, fields == 0 ? fmt::format("{}: no body is given; accepted: a mesh file (part.mesh or MODEL), "
                                        "part.shape / --shape, or a [[field]]",
                                        begin)
                          : fmt::format("{}: no body is given; accepted: part.field / --field with the name "
                                        "of one of the {} [[field]] entries",
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
    if (count(*find_section("cavity")) > 0) check_need({"cavity", 0}, "wall", "a cavity");
    if (count(*find_section("shield")) > 0) check_need({"shield", 0}, "gap", "a shield");
    if (count(*find_section("frame")) > 0) check_need({"frame", 0}, "beam", "a frame");
    check_problem_keys();
}

/// Checks that the pixel size is given in one way: by its edge, both its sides, or dots per inch. A flag has
/// precedence over the recipe.
void RecipeDraft::check_pixels() {
    const std::vector<std::vector<std::string>> ways{{"pixel"}, {"dpi"}, {"pixel_x", "pixel_y"}};
    const auto given = [&](const std::vector<std::string>& way, bool flags_only) -> const Entry* {
        for (const std::string& key : way) {
            const Entry* one = entry("printer", key);
            if (one && (one->from_flag || !flags_only)) return one;
        }
        return nullptr;
    };
    const auto flagged = [&](const auto& way) { return given(way, true) != nullptr; };
    if (std::any_of(ways.begin(), ways.end(), flagged)) {
        for (const auto& way : ways) {
            if (flagged(way)) continue;
            for (const std::string& key : way) entries_.erase({"printer", 0, key});
        }
    }
    const Entry* first = nullptr;
    for (const auto& way : ways) {
        const Entry* one = given(way, false);
        if (first && one) {
            refuse(0, fmt::format(
                          "{}: conflicts with {}; accepted: pixel alone, dpi alone, or pixel_x and pixel_y",
                          one->where, first->where));
        }
        if (!first) first = one;
    }
}

/// Looks up the recipe's profile.
void RecipeDraft::check_printer() {
    check_pixels();
    const Entry* given = entry("printer", "profile");
    const std::string name = given && given->value ? std::get<std::string>(*given->value) : default_profile;
    try {
        if (const auto found = profiles_.find(name)) {
            machine_ = found->printer;
        } else {
            refuse(0, fmt::format("{}: {}", where("printer", "profile"), profiles_.unknown(name)));
        }
    } catch (const InputError& error) {
        refuse(0, error.what());
    }
}

Recipe RecipeDraft::assemble() {
    Recipe recipe;
    recipe.printer = machine_;
    if (const Entry* named = entry("printer", "profile"))
        recipe.machine = std::get<std::string>(*named->value);
    for (const auto& [place, given] : entries_) {
        const Setting& setting = *find_setting(place.section, place.key);
        if (given.value && setting.name() != "printer.profile") {
            setting.store(recipe, place.entry, *given.value);
        }
    }
    if (count(*find_section("support")) > 0) {
        // Any number of [support] enables supports, unless support.kind is given.
        const Entry* kind = entry("support", "kind");
        recipe.support = SupportKind::bridges;
        if (kind && kind->value) find_setting("support", "kind")->store(recipe, 0, *kind->value);
    }
    for (std::size_t i = 0; i < recipe.fields.size(); ++i) recipe.fields[i].where = where_begins("field", i);
    for (std::size_t i = 0; i < recipe.gradings.size(); ++i) {
        recipe.gradings[i].where = where_begins("grading", i);
    }
    hand_over("field", recipe.fields, host_fields_);
    hand_over("grading", recipe.gradings, host_gradings_);
    for (std::size_t i = 0; i < recipe.regions.size(); ++i)
        recipe.regions[i].where = where_begins("region", i);
    for (std::size_t i = 0; i < recipe.loads.size(); ++i) recipe.loads[i].where = where_begins("load", i);
    for (std::size_t i = 0; i < recipe.anchors.size(); ++i)
        recipe.anchors[i].where = where_begins("anchor", i);
    for (std::size_t i = 0; i < recipe.element_shapes.size(); ++i)
        recipe.element_shapes[i].where = where_begins("element", i);
    for (std::size_t i = 0; i < recipe.holes.size(); ++i) recipe.holes[i].where = where_begins("hole", i);
    for (std::size_t i = 0; i < recipe.cuts.size(); ++i) recipe.cuts[i].where = where_begins("cut", i);
    if (count(*find_section("optimize")) > 0 && !recipe.optimize) recipe.optimize.emplace();
    if (count(*find_section("elements")) > 0 && !recipe.elements) recipe.elements.emplace();
    if (recipe.optimize && recipe.optimize->kind == OptimizeKind::lightness && !entry("optimize", "volume"))
        recipe.optimize->volume = OptimizeRecipe::whole_part;
    if (recipe.optimize && recipe.optimize->kind == OptimizeKind::appearance) {
        if (!entry("optimize", "method")) recipe.optimize->method = OptimizeMethod::mma;
        if (!entry("optimize", "dimensions")) recipe.optimize->dimensions = 2;
    }
    // A skin of no thickness is none, unless a region gives it one: its other keys hold there.
    const auto makes_skin = [](const RegionRecipe& region) { return region.make == RegionMake::skin; };
    if (std::any_of(recipe.regions.begin(), recipe.regions.end(), makes_skin)) {
        if (!recipe.skin) recipe.skin.emplace();
    } else if (recipe.skin && recipe.skin->thickness == GradedNumber{}) {
        recipe.skin.reset();
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

/// Returns false where a mistake hides the name of a [[grading]], which formulas may well use.
bool RecipeDraft::knows_all_gradings() const {
    const std::size_t gradings = count(*find_section("grading"));
    for (std::size_t i = 0; i < gradings; ++i) {
        const Entry* name = entry("grading", "name", i);
        if (name == nullptr || !name->value) return false;
    }
    return true;
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
        check_problem(recipe);
        check_elements(recipe);
    } else if (knows_all_gradings()) {
        for (std::string& mistake : formula_text_mistakes(recipe)) refuse(0, std::move(mistake));
    }
    throw_mistakes();
    return recipe;
}

void RecipeDraft::throw_mistakes() {
    if (mistakes_.empty()) return;
    std::stable_sort(mistakes_.begin(), mistakes_.end(), [](const Mistake& a, const Mistake& b) {
        return (a.line ? a.line : 1 << 30) < (b.line ? b.line : 1 << 30);
    });
    std::string text;
    for (const Mistake& mistake : mistakes_) text += (text.empty() ? "" : "\n") + mistake.text;
    throw InputError(text);
}

std::string RecipeDraft::profile_kind(const std::string& path) {
    const Entry* kind = entry("printer", "kind");
    if (!kind) {
        refuse(0, fmt::format("{}: neither based_on nor printer.kind is given; accepted: based_on = the name "
                              "of another profile, or printer.kind = {}",
                              path, accepted(*find_setting("printer", "kind"))));
    }
    throw_mistakes();
    return std::get<std::string>(*kind->value);
}

PrinterProfile RecipeDraft::finish_profile(const PrinterProfile& base) {
    check_pixels();
    Recipe recipe;
    recipe.printer = base;
    for (const auto& [place, given] : entries_) {
        if (given.value) find_setting(place.section, place.key)->store(recipe, 0, *given.value);
    }
    if (mistakes_.empty()) check_support(recipe.printer);
    throw_mistakes();
    return recipe.printer;
}

}  // namespace lamella
