// Finds and loads modules with dlopen.
#include "engine/base/module_file.h"

#include <dlfcn.h>

#include "engine/base/error.h"

namespace lamella {

void* module_function(const std::string& file, const char* function, ModuleScope scope,
                      const std::string& lacking, const std::string& advice) {
    const int how = RTLD_NOW | (scope == ModuleScope::shared ? RTLD_GLOBAL : RTLD_LOCAL);
    void* module = dlopen(file.c_str(), how);
    const std::string why = module != nullptr ? "" : dlerror();
    if (module == nullptr) module = dlopen((LAMELLA_MODULE_FOLDER "/" + file).c_str(), how);
    if (module == nullptr) throw FaultError(lacking + ": " + why + "; " + advice);
    void* found = dlsym(module, function);
    if (found == nullptr) throw FaultError(file + " is not lamella's: " + dlerror());
    return found;
}

}  // namespace lamella
