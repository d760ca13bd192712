// Runs of the `lamella` command as its users start it, with a cache of their own.
#pragma once

#include <fcntl.h>
#include <pty.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "tests/app/commands/folder.h"
#include "tests/app/commands/mentions.h"

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

/// Starts a shell's line; "exec" in front makes its command this process.
inline pid_t start_shell(const std::string& line) {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
        _exit(127);
    }
    return child;
}

/// Starts `lamella`, whose output goes to the folder's files `out` and `err`.
inline pid_t start_lamella(const std::string& arguments, const Folder& folder) {
    return start_shell("exec env " + command_line(arguments, folder / "cache") + " >" + folder / "out" +
                       " 2>" + folder / "err" + " </dev/null");
}

/// `lamella` on a terminal of its own, 80 columns wide, whose keys are pressed and whose screen is read.
class OnTerminal {
  public:
    OnTerminal(const std::string& arguments, const Folder& folder)
        : OnTerminal("exec env " + command_line(arguments, folder / "cache")) {}
    /// Runs a shell's line.
    explicit OnTerminal(const std::string& line) {
        const winsize size{24, 80, 0, 0};
        child_ = forkpty(&terminal_, nullptr, nullptr, &size);
        REQUIRE(child_ >= 0);
        if (child_ == 0) {
            execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
            _exit(127);
        }
        fcntl(terminal_, F_SETFL, O_NONBLOCK);
    }
    ~OnTerminal() {
        if (child_ > 0) kill(child_, SIGKILL), waitpid(child_, nullptr, 0);
        hang_up();
    }
    /// The terminal is closed, as by the window's button or a line that breaks.
    void hang_up() {
        if (terminal_ >= 0) close(terminal_);
        terminal_ = -1;
    }
    OnTerminal(const OnTerminal&) = delete;
    OnTerminal& operator=(const OnTerminal&) = delete;

    void press(char key) { REQUIRE(::write(terminal_, &key, 1) == 1); }
    /// All that was written so far.
    const std::string& screen() {
        char buffer[4096];
        for (ssize_t got = 0; (got = read(terminal_, buffer, sizeof buffer)) > 0;)
            screen_.append(buffer, static_cast<std::size_t>(got));
        return screen_;
    }
    /// Whether a text appears behind what was on the screen when `forget` was called last.
    bool shows(const std::string& text) { return screen().find(text, seen_) != std::string::npos; }
    void forget() { seen_ = screen().size(); }
    /// Whether keys are echoed and read by the line, as a shell wants them.
    bool is_as_it_was() const {
        termios mode{};
        return tcgetattr(terminal_, &mode) == 0 && (mode.c_lflag & ICANON) != 0 && (mode.c_lflag & ECHO) != 0;
    }
    /// Reads on until it ends. -1 when it was killed.
    int exit_code() {
        int status = 0;
        while (waitpid(child_, &status, WNOHANG) == 0) {
            screen();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        child_ = -1;
        screen();
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

  private:
    int terminal_ = -1;
    pid_t child_ = -1;
    std::string screen_;
    std::size_t seen_ = 0;
};

/// Runs `lamella` and interrupts it as soon as `when` says so, which it must within two minutes.
template <class Condition>
Outcome interrupt_lamella(const std::string& arguments, Condition when) {
    const Folder folder;
    const pid_t child = start_lamella(arguments, folder);
    bool due = when();
    for (int i = 0; i < 12000 && !due; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        due = when();
    }
    kill(child, SIGINT);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(due);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder / "out"), contents(folder / "err")};
}

}  // namespace lamella
