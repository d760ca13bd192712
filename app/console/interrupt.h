// Signals: those that ask a run to stop cleanly, and those of a terminal that a print outlives.
#pragma once

#include <csignal>

#include "engine/layers/layer_stream.h"

namespace lamella {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP sets the token. A second SIGINT or SIGTERM ends the
/// process at once; further SIGHUP do not, because a closed terminal may send several. A SIGHUP that is
/// ignored when it is made, as under nohup, stays ignored. Only one may exist at a time.
class InterruptGuard {
  public:
    explicit InterruptGuard(CancelToken& token);
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// Keeps a print going whatever happens to its terminal. While it lives:
/// SIGHUP, of a terminal that was closed, only sets `hung_up`;
/// SIGTSTP (Ctrl-Z) does not stop the process, which would leave a hot nozzle on the part;
/// SIGTTIN and SIGTTOU do not either, when it runs in the background;
/// SIGCONT and SIGUSR1 are noted.
/// Make it after an InterruptGuard. Only one may exist at a time.
class TerminalGuard {
  public:
    /// With `stop_on_hangup`, SIGHUP is left to the InterruptGuard.
    explicit TerminalGuard(bool stop_on_hangup);
    ~TerminalGuard();
    TerminalGuard(const TerminalGuard&) = delete;
    TerminalGuard& operator=(const TerminalGuard&) = delete;

    /// Returns true once the terminal is gone.
    static bool hung_up();
    /// Each returns true once after the signal has come.
    static bool take_stop();
    static bool take_continue();
    static bool take_user();

  private:
    struct Handled {
        int number;
        struct sigaction before;
    };
    Handled handled_[6];
    int count_ = 0;
};

}  // namespace lamella
