// A bound on the nesting of TOML, checked before it is parsed.
#pragma once

#include <string>
#include <string_view>

namespace lamella {

/// Nesting that is accepted: parts of a dotted key, and brackets within brackets. Recipes need 3 of each.
inline constexpr int deepest_toml = 16;

/// Throws InputError("path:line:column: ...") if a key has more than `deepest_toml` parts, or arrays and
/// tables are nested deeper: tables are made, searched and destroyed by recursion. Text that is no TOML may
/// pass; the parser refuses it before it could nest.
void require_shallow_toml(std::string_view text, const std::string& path);

}  // namespace lamella
