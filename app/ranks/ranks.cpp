// The environment tells whether mpirun started this process; the MPI module is loaded only then.
#include "app/ranks/ranks.h"

#include <array>
#include <cstdlib>

#include "engine/base/module_file.h"

namespace lamella {
namespace {

/// Returns the number of processes that the launcher states: Open MPI, MPICH and Intel MPI, or PMIx.
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
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): a loader knows no types
    const auto make = reinterpret_cast<MakeRanksFunction>(
        module_function("liblamella_mpi.so", "lamella_make_ranks", ModuleScope::shared,
                        "was started by mpirun, but is built without MPI",
                        "accepted: a lamella built with MPI, or a single process"));
    return std::unique_ptr<Ranks>(make());
}

}  // namespace lamella
