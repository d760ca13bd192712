// Runs of the `lamella` command by several processes, as mpirun starts them.
#pragma once

#include "tests/app/command_run.h"
#include "tests/app/folder.h"

#ifdef LAMELLA_MPIRUN
namespace lamella {

/// Runs mpirun with these arguments (a shell's words). The output goes to the folder's files `out` and `err`.
inline Outcome mpirun(const std::string& arguments, const Folder& folder) {
    const std::string line = "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " LAMELLA_MPIRUN
                             " --oversubscribe " +
                             arguments + " >" + folder / "out" + " 2>" + folder / "err" + " </dev/null";
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder / "out"), contents(folder / "err")};
}

}  // namespace lamella
#endif
