// The settings table: every recipe key and every recipe flag of the command, described once.
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

/// A setting's value from a recipe or the command line. Choices and paths are text.
using Value =
    std::variant<bool, std::int64_t, double, std::string, dvec3, GradedNumber, GradedTriple, NumberRows>;

enum class ValueType : unsigned char {
    boolean,
    integer,
    number,
    text,
    lines,  ///< one or more lines of text: in a recipe a multi-line text or a list of texts
    path,   ///< path of a file, relative to the recipe's folder; of an input, the bytes count for the
            ///< identity
    choice,
    triple,
    graded,         ///< a number, or a formula over place, depth and gradings
    graded_triple,  ///< three of them
    formula,        ///< a formula, not a number
    rows            ///< rows of numbers; see RowShape
};

/// The shape of settings that are rows of numbers.
struct RowShape {
    std::size_t columns = 0;
    std::size_t rows = 0;   ///< 0: one or more
    const char* form = "";  ///< description for messages: "points [[x, y, z], ...]"
};

/// The numbers that a setting accepts; for triples and rows, each of them.
struct Limits {
    double lo = -infinity;
    double hi = infinity;
};

/// One row of the table. TOML reading, command-line options, help, the key listing and the job's identity are
/// generated from it.
struct Setting {
    std::string section;
    std::string key;
    std::string flag;  ///< long option of the command, with dashes; empty in list sections
    ValueType type;
    std::string unit;  ///< "mm", "px" and so on; empty for none
    Limits limits;
    std::vector<std::string> choices;  ///< accepted words of a choice
    RowShape shape;
    std::string fallback;  ///< the default, as text for people
    std::string help;      ///< one sentence
    /// The second argument is the index of an entry of a list section, which grows as needed; other sections
    /// ignore it.
    void (*store)(Recipe&, std::size_t, const Value&);
    Value (*load)(const Recipe&, std::size_t);

    std::string name() const { return section + "." + key; }
};

/// Returns all settings, ordered by section.
/// ```
///     const Setting* cell = find_setting("foam", "cell");
///     std::string wrong;
///     if (const auto value = parse_value(*cell, "2.5 + 0.1*z", wrong)) {
///         Recipe recipe;
///         cell->store(recipe, 0, *value);
///     } else {
///         throw InputError(cell->flag + ": " + wrong + "; accepted: " + accepted(*cell));
///     }
/// ```
std::span<const Setting> settings();

/// A section of the recipe, in the table's order.
struct Section {
    std::string name;
    std::string help;
    /// Returns the number of entries of a list section ([[name]], repeatable); null for plain sections.
    std::size_t (*entries)(const Recipe&) = nullptr;
    bool decides_layers = true;  ///< whether its keys are part of the job's identity

    bool is_list() const { return entries != nullptr; }
    /// "[foam]" or "[[grading]]".
    std::string title() const { return is_list() ? "[[" + name + "]]" : "[" + name + "]"; }
};
std::span<const Section> sections();

/// The sections that a machine's profile may have.
inline constexpr std::array<const char*, 4> profile_sections{"printer", "support", "check", "host"};

/// Whether a key of one of these sections belongs in recipes alone.
bool belongs_in_recipe(const Setting& setting);

/// Returns the section of that name; null when there is none.
const Section* find_section(std::string_view name);

/// Returns "[part], [foam], ...": all sections, for messages.
std::string section_titles();

/// Returns the setting of a key; null when there is none.
const Setting* find_setting(std::string_view section, std::string_view key);

/// Returns what a setting accepts, for messages and help: "a number from 0.05 to 1000 mm".
std::string accepted(const Setting& setting);

/// Returns why a value of the setting's type is not accepted ("3000 is too large"); nothing when it is.
std::optional<std::string> objection(const Setting& setting, const Value& value);

/// Parses a value from the text of a flag. Returns nothing on a mistake, and its description in `wrong`.
std::optional<Value> parse_value(const Setting& setting, const std::string& text, std::string& wrong);

/// Returns a value as text for a flag, with numbers in their shortest exact form. parse_value reads it back.
std::string format_value(const Value& value);

/// Parses exactly `count` numbers separated by commas; returns nothing for any other text. The numbers may be
/// infinite or NaN.
std::optional<std::vector<double>> parse_numbers(std::string_view text, std::size_t count);

/// Returns the candidate nearest to a misspelt word; empty when none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// Returns the reference of all keys, or of one section's: a paragraph for each section, two lines for each
/// key with its meaning, range, default and flag. Throws InputError where there is no such section.
std::string settings_reference(std::string_view only_section = {});
/// Returns the reference as a Markdown page, a table for each section.
std::string settings_markdown();

}  // namespace lamella
