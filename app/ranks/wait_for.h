// Polls until a result arrives or the token is cancelled.
#pragma once

#include <chrono>
#include <thread>

#include "engine/base/cancel_token.h"

namespace lamella {

/// Polls at short intervals until there is an answer, so that waiting uses no processor time. Throws
/// Interrupted when cancelled.
template <typename Ask>
auto wait_for(const Ask& ask, const CancelToken* cancel) {
    for (;;) {
        if (auto found = ask()) return found;
        stop_if_cancelled(cancel);
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
}

}  // namespace lamella
