// Modules: parts of the program that stand in libraries of their own, loaded when they are needed.
#pragma once

#include <string>

namespace lamella {

/// Who else sees what a module's library exports and brings along.
enum class ModuleScope { own, shared };

/// A function that a module exports. `file`: its library's name, looked for where the program's own run path
/// says, then where it was installed to; it is loaded once and never unloaded. Throws FaultError where it has
/// no such function, and where there is no such library: then the message is what is `lacking`, the loader's
/// reason, and the `advice`.
void* module_function(const std::string& file, const char* function, ModuleScope scope,
                      const std::string& lacking, const std::string& advice);

}  // namespace lamella
