// The signal handlers and the flags that they can reach.
#include "app/console/interrupt.h"

#include <atomic>

namespace lamella {

namespace {

std::atomic<CancelToken*> listening{nullptr};
static_assert(std::atomic<CancelToken*>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");
std::atomic<bool> hang_up_seen{false}, stop_seen{false}, continue_seen{false}, user_seen{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void on_signal(int) {
    if (CancelToken* token = listening.load()) token->cancel();
}

extern "C" void on_terminal_signal(int number) {
    if (number == SIGHUP) hang_up_seen = true;
    if (number == SIGTSTP) stop_seen = true;
    if (number == SIGCONT) continue_seen = true;
    if (number == SIGUSR1) user_seen = true;
}

struct sigaction hangup_before {};  // what SIGHUP did before the guard

struct sigaction action_of(void (*handler)(int), bool once) {
    struct sigaction action {};
    action.sa_handler = handler;
    sigemptyset(&action.sa_mask);
    action.sa_flags = once ? static_cast<int>(SA_RESTART | SA_RESETHAND) : SA_RESTART;
    return action;
}

}  // namespace

InterruptGuard::InterruptGuard(CancelToken& token) {
    listening.store(&token);
    const struct sigaction once = action_of(on_signal, true), always = action_of(on_signal, false);
    sigaction(SIGINT, &once, nullptr);
    sigaction(SIGTERM, &once, nullptr);
    sigaction(SIGHUP, nullptr, &hangup_before);
    if (hangup_before.sa_handler != SIG_IGN) sigaction(SIGHUP, &always, nullptr);
}

InterruptGuard::~InterruptGuard() {
    const struct sigaction standard = action_of(SIG_DFL, false);
    sigaction(SIGINT, &standard, nullptr);
    sigaction(SIGTERM, &standard, nullptr);
    sigaction(SIGHUP, &hangup_before, nullptr);
    listening.store(nullptr);
}

TerminalGuard::TerminalGuard(bool stop_on_hangup) {
    hang_up_seen = stop_seen = continue_seen = user_seen = false;
    const struct sigaction note = action_of(on_terminal_signal, false), ignore = action_of(SIG_IGN, false);
    const auto handle = [&](int number, const struct sigaction& action) {
        Handled& handled = handled_[count_++];
        handled.number = number;
        sigaction(number, &action, &handled.before);
        // What the parent has the process ignore stays ignored.
        if (handled.before.sa_handler == SIG_IGN) sigaction(number, &handled.before, nullptr);
    };
    if (!stop_on_hangup) handle(SIGHUP, note);
    for (const int number : {SIGTSTP, SIGCONT, SIGUSR1}) handle(number, note);
    for (const int number : {SIGTTIN, SIGTTOU}) handle(number, ignore);
}

TerminalGuard::~TerminalGuard() {
    while (count_ > 0) {
        --count_;
        sigaction(handled_[count_].number, &handled_[count_].before, nullptr);
    }
}

bool TerminalGuard::hung_up() { return hang_up_seen; }
bool TerminalGuard::take_stop() { return stop_seen.exchange(false); }
bool TerminalGuard::take_continue() { return continue_seen.exchange(false); }
bool TerminalGuard::take_user() { return user_seen.exchange(false); }

}  // namespace lamella
