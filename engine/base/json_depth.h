// A bound on the nesting of JSON, checked before it is parsed.
#pragma once

#include <string_view>

namespace lamella {

/// Nesting that is accepted. Nothing that is read nests more than 10 deep.
inline constexpr int deepest_json = 64;

/// Returns the text; an empty one, which no parser accepts, if its lists and objects are nested more than
/// `deepest_json` deep: parsed values are copied, compared and written by recursion. Brackets in strings do
/// not count.
std::string_view shallow_json(std::string_view text);

}  // namespace lamella
