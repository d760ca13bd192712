// Plugins: back-ends in shared libraries that export lamella_plugin_entry.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "recipe/output/outputs.h"

namespace lamella {

/// Loads a plugin; it stays loaded as long as any back-end of its lives. Throws InputError where there is no
/// such file, it is no plugin, or it is one for another version of the interface.
OutsideBackend load_plugin(const std::string& path);

}  // namespace lamella
