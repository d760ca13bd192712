// Tables that ship with the program, as the text of their files; made when the program is built.
#pragma once

#include <string_view>

namespace lamella {

/// materials/materials.toml.
std::string_view shipped_materials();
/// materials/foam_laws.csv.
std::string_view shipped_foam_laws();

}  // namespace lamella
