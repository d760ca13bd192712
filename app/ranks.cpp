// Whether mpirun started us is said by its environment; its library is loaded only then.
#include "app/ranks.h"

#include <dlfcn.h>

#include <array>
#include <cstdlib>

#include "engine/error.h"

namespace lamella {
namespace {

constexpr const char* module_name = "liblamella_mpi.so";

/// How many processes the launcher says that there are: Open MPI, MPICH and Intel MPI, or PMIx.
int launched() {
    for (const char* name : std::array{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
        const char* size = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nothing sets it
        if (size != nullptr) return std::atoi(size);
    }
    return 1;
}

}  // namespace

std::unique_ptr<Ranks> started_ranks() {
    if (launched() < 2) return nullptr;
    void* module = dlopen(module_name, RTLD_NOW | RTLD_GLOBAL);
    if (module == nullptr)
        module = dlopen(LAMELLA_MODULE_FOLDER "/liblamella_mpi.so", RTLD_NOW | RTLD_GLOBAL);
    if (module == nullptr) {
        throw FaultError(std::string("was started by mpirun, but has no MPI: ") + dlerror() +
                         "; accepted: a lamella that was built where MPI is installed, or one process");
    }
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): dlsym knows no types
    const auto make = reinterpret_cast<MakeRanksFunction>(dlsym(module, "lamella_make_ranks"));
    if (make == nullptr) throw FaultError(std::string(module_name) + " is not lamella's: " + dlerror());
    return std::unique_ptr<Ranks>(make());
}

}  // namespace lamella
