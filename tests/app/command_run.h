// Runs of the `lamella` command as its users start it, with a cache of their own.
#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "tests/app/folder.h"
#include "tests/app/mentions.h"

namespace lamella {

struct Outcome {
    int code = -1;
    std::string out;
    std::string err;
};

/// The shell's line that runs `lamella` with these arguments (a shell's words). Nothing of the user's cache
/// is read or written: plans are kept in the folder `cache`, and profiles in the user's home are not seen.
inline std::string command_line(const std::string& arguments, const std::string& cache) {
    return "XDG_CACHE_HOME=" + cache + " XDG_CONFIG_HOME=${XDG_CONFIG_HOME:-" + cache + "} " +
           LAMELLA_COMMAND + " " + arguments;
}

/// Runs `lamella` with an empty cache.
inline Outcome run_lamella(const std::string& arguments) {
    const Folder folder;
    const std::string line = command_line(arguments, folder / "cache") + " >" + folder / "out" + " 2>" +
                             folder / "err" + " </dev/null";
    const int status = std::system(line.c_str());
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder / "out"),
                    contents(folder / "err")};
    UNSCOPED_INFO("lamella " << arguments << "\nexit code " << outcome.code << "\n" << outcome.err);
    return outcome;
}

/// Starts `lamella`, whose output goes to the folder's files `out` and `err`.
inline pid_t start_lamella(const std::string& arguments, const Folder& folder) {
    const std::string line = "exec env " + command_line(arguments, folder / "cache") + " >" + folder / "out" +
                             " 2>" + folder / "err" + " </dev/null";
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
        _exit(127);
    }
    return child;
}

/// Runs `lamella` and interrupts it as soon as `when` says so, or after 20 s.
template <class Condition>
Outcome interrupt_lamella(const std::string& arguments, Condition when) {
    const Folder folder;
    const pid_t child = start_lamella(arguments, folder);
    for (int i = 0; i < 2000 && !when(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    kill(child, SIGINT);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder / "out"), contents(folder / "err")};
}

}  // namespace lamella
