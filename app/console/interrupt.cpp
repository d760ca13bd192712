// The signal handler and the single pointer that it can reach.
#include "app/console/interrupt.h"

#include <csignal>

namespace lamella {

namespace {

std::atomic<CancelToken*> listening{nullptr};
static_assert(std::atomic<CancelToken*>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

extern "C" void on_signal(int) {
    if (CancelToken* token = listening.load()) token->cancel();
}

void handle(void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    sigemptyset(&action.sa_mask);
    action.sa_flags = handler == SIG_DFL ? SA_RESTART : static_cast<int>(SA_RESTART | SA_RESETHAND);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard(CancelToken& token) {
    listening.store(&token);
    handle(on_signal);
}

InterruptGuard::~InterruptGuard() {
    handle(SIG_DFL);
    listening.store(nullptr);
}

}  // namespace lamella
