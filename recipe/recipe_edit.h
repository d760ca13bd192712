// Changes of keys in a recipe's text that leave all else as it stands: comments, order, spaces.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// A change of a recipe's text.
struct RecipeChange {
    std::string section;
    std::size_t entry = 0;             ///< of a list section, from 0; its number of entries appends one
    std::string key;                   ///< empty: the whole section or entry
    std::optional<std::string> value;  ///< as text for a flag; empty: the key, or the section, is removed
};

/// Returns the text with the changes, one after the other. Sections that are missing are added at the end.
/// Throws InputError when the text is no TOML, a section or key is unknown, a value is not accepted, an entry
/// does not exist, or a section is written as an inline table, whose keys have no lines of their own.
std::string edited_recipe(std::string text, std::span<const RecipeChange> changes);

/// A key that a recipe's text gives.
struct GivenKey {
    std::string section;
    std::size_t entry = 0;
    std::string key;
    std::string value;  ///< as text for a flag; empty where it has the wrong type
    int line = 0;
};

/// Returns the known keys of a recipe's text in its order, mistaken values included. Throws InputError when
/// the text is no TOML.
std::vector<GivenKey> given_keys(std::string_view text);

}  // namespace lamella
