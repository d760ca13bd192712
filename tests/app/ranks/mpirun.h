// Runs of the `lamella` command by several processes, as mpirun starts them.
#pragma once

#include <optional>
#include <sstream>

#include "tests/app/commands/command_run.h"
#include "tests/app/commands/folder.h"

#ifdef LAMELLA_MPIRUN
namespace lamella {

/// Whether a process has a child that has not ended.
inline bool has_living_child(pid_t parent) {
    std::error_code gone;
    for (const auto& task :
         std::filesystem::directory_iterator("/proc/" + std::to_string(parent) + "/task", gone)) {
        std::istringstream children(contents(task.path() / "children"));
        for (std::string child; children >> child;) {
            const std::string status = contents("/proc/" + child + "/status");
            if (!status.empty() && !mentions(status, "State:\tZ")) return true;
        }
    }
    return false;
}

/// How a launcher ended; nothing if it hangs although nothing of what it started has lived for half a minute.
inline std::optional<int> wait_for_launcher(pid_t launcher) {
    int status = 0;
    for (int seconds_alone = 0; seconds_alone < 30;) {
        for (int i = 0; i < 200; ++i) {
            if (waitpid(launcher, &status, WNOHANG) == launcher) return status;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        seconds_alone = has_living_child(launcher) ? 0 : seconds_alone + 1;
    }
    kill(launcher, SIGKILL);
    waitpid(launcher, &status, 0);
    return std::nullopt;
}

/// Runs mpirun with these arguments (a shell's words). The output goes to the folder's files `out` and `err`.
/// A launcher that hangs after its processes have ended is started again: that of OpenMPI 4.1 with PMIx 4.2
/// does so once in some thousand runs (a deadlock in PMIx_server_finalize). So is one that dies of a signal
/// of its own: how its processes ended it tells by an exit code.
inline Outcome mpirun(const std::string& arguments, const Folder& folder) {
    const std::string line =
        // Open MPI unloads modules together with what they allocated, which leak checkers call lost.
        "exec env ASAN_OPTIONS=detect_leaks=0 OMPI_ALLOW_RUN_AS_ROOT=1 "
        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " LAMELLA_MPIRUN " --oversubscribe " +
        arguments + " >" + folder / "out" + " 2>" + folder / "err" + " </dev/null";
    std::optional<int> status;
    for (int attempt = 0; attempt < 3 && !(status && WIFEXITED(*status)); ++attempt)
        status = wait_for_launcher(start_shell(line));
    const bool exited = status && WIFEXITED(*status);
    return {exited ? WEXITSTATUS(*status) : -1, contents(folder / "out"), contents(folder / "err")};
}

/// `lamella` by so many processes, with nothing of the user's; 0: without mpirun.
inline Outcome run_by(int size, const std::string& arguments, const Folder& folder) {
    if (size == 0) return run_lamella(arguments);
    return mpirun("-x XDG_CACHE_HOME=" + folder / "cache" + " -n " + std::to_string(size) + " " +
                      LAMELLA_COMMAND + " " + arguments,
                  folder);
}

/// How often words occur in a text.
inline std::size_t times(const std::string& text, const std::string& words) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(words, at)) != std::string::npos; ++at) ++count;
    return count;
}

}  // namespace lamella
#endif
