// Built-in tables, as the text of their files; the source is generated at build time.
#pragma once

#include <string_view>

namespace lamella {

/// Returns the text of materials/materials.toml.
std::string_view shipped_materials();
/// Returns the text of materials/foam_laws.csv.
std::string_view shipped_foam_laws();

}  // namespace lamella
