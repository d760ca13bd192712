// Plugins: back-ends in shared libraries that export lamella_plugin_entry.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "recipe/output/outputs.h"

namespace lamella {

/// Loads a plugin, which stays loaded while any of its back-ends lives. Throws InputError when the file is
/// missing, is not a plugin, or is built for another version of the interface.
OutsideBackend load_plugin(const std::string& path);

}  // namespace lamella
