// Modules: parts of the program in shared libraries of their own, loaded on demand.
#pragma once

#include <string>

namespace lamella {

/// Visibility of the symbols of a module and of its dependencies: to the module alone, or to all libraries.
enum class ModuleScope { own, shared };

/// Returns a function that a module exports. `file` is the name of its library, searched along the program's
/// run path, then in the installation folder. A module is loaded once and never unloaded. Throws FaultError
/// when the library has no such function, or when there is no such library; the latter message consists of
/// `lacking`, the loader's reason and `advice`.
void* module_function(const std::string& file, const char* function, ModuleScope scope,
                      const std::string& lacking, const std::string& advice);

}  // namespace lamella
