// Values of settings in TOML.
#pragma once

#include <toml++/toml.h>
#include <optional>
#include <string>
#include <string_view>

#include "recipe/settings.h"

namespace lamella {

/// Parses TOML; `path` names it in messages. Throws InputError with line and column where it is none, or is
/// nested too deep.
toml::table parse_toml(std::string_view text, const std::string& path);

/// Returns the node as a value of the setting's type; nothing when its type differs.
std::optional<Value> value_of(const Setting& setting, const toml::node& node);

/// Returns a text between quotes.
std::string toml_quoted(std::string_view text);

/// Returns a value as it stands in a recipe: value_of() reads it back.
std::string toml_literal(const Setting& setting, const Value& value);

}  // namespace lamella
