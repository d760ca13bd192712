// The settings table: every key of a recipe and every recipe flag of the command, described once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "recipe/recipe.h"

namespace lamella {

/// A setting's value as it stands in a recipe or on the command line. Choices and paths are text.
using Value =
    std::variant<bool, std::int64_t, double, std::string, dvec3, GradedNumber, GradedTriple, NumberRows>;

enum class ValueType : unsigned char {
    boolean,
    integer,
    number,
    text,
    lines,  ///< one or more lines of text: in a recipe a text of several lines or a list of texts
    path,   ///< of a file: in a recipe it starts at the recipe's folder; an input's bytes count
    choice,
    triple,
    graded,         ///< a number, or a formula over place, depth and gradings
    graded_triple,  ///< three of them
    formula,        ///< a formula only
    rows            ///< rows of numbers; see RowShape
};

/// How many numbers a row holds and how many rows there are, for settings that are rows.
struct RowShape {
    std::size_t columns = 0;
    std::size_t rows = 0;   ///< 0: one or more
    const char* form = "";  ///< "points [[x, y, z], ...]", for people
};

/// The numbers that a setting accepts; for triples and rows, each of them.
struct Limits {
    double lo = -infinity;
    double hi = infinity;
};

/// One row of the table. TOML reading, command-line options, help, the key listing and the job's identity are
/// all made from it.
struct Setting {
    std::string section;
    std::string key;
    std::string flag;  ///< long option of the command, with its dashes; empty in list sections
    ValueType type;
    std::string unit;  ///< "mm", "px" and so on; empty where there is none
    Limits limits;
    std::vector<std::string> choices;  ///< accepted words of a choice
    RowShape shape;
    std::string fallback;  ///< what holds when the setting is absent, for people
    std::string help;      ///< one sentence
    /// The second argument counts the entries of a list section, which grows as needed; other sections
    /// ignore it.
    void (*store)(Recipe&, std::size_t, const Value&);
    Value (*load)(const Recipe&, std::size_t);

    std::string name() const { return section + "." + key; }
};

/// All settings, ordered by section.
std::span<const Setting> settings();

/// A section of the recipe, in the table's order.
struct Section {
    std::string name;
    std::string help;
    /// How many entries a list section ([[name]], as often as wanted) has; null for plain sections.
    std::size_t (*entries)(const Recipe&) = nullptr;
    bool decides_layers = true;  ///< whether its keys are part of the job's identity

    bool is_list() const { return entries != nullptr; }
    /// "[foam]" or "[[grading]]".
    std::string title() const { return is_list() ? "[[" + name + "]]" : "[" + name + "]"; }
};
std::span<const Section> sections();

/// The sections that a machine's profile may have.
inline constexpr std::array<const char*, 3> profile_sections{"printer", "support", "check"};

/// The section of that name, null when there is none.
const Section* find_section(std::string_view name);

/// "[part], [foam], ...": all sections, for messages.
std::string section_titles();

/// The row of a key, null when there is none.
const Setting* find_setting(std::string_view section, std::string_view key);

/// "a number from 0.05 to 1000 mm": what a setting accepts, for messages and help.
std::string accepted(const Setting& setting);

/// What is wrong with a value of the setting's type ("3000 is too large"); nothing when it is fine.
std::optional<std::string> objection(const Setting& setting, const Value& value);

/// Reads a value from the text of a flag; `wrong` receives what is wrong with it when nothing is returned.
std::optional<Value> parse_value(const Setting& setting, const std::string& text, std::string& wrong);

/// The value as a flag would be given it; numbers in their shortest exact form. parse_value reads it back.
std::string format_value(const Value& value);

/// Exactly `count` numbers with commas between them; nothing when the text is anything else. The numbers may
/// be infinite or NaN.
std::optional<std::vector<double>> parse_numbers(std::string_view text, std::size_t count);

/// The candidate that a misspelt word most likely means; empty when none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// Returns the reference of all keys, or of one section's: a paragraph a section, two lines a key with its
/// meaning, range, default and flag. Throws InputError where there is no such section.
std::string settings_reference(std::string_view only_section = {});
/// Returns the same as a Markdown page, a table a section.
std::string settings_markdown();

}  // namespace lamella
