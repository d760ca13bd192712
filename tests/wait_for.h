// Waiting for what another thread or process does.
#pragma once

#include <chrono>
#include <thread>

namespace lamella {

/// Returns true as soon as the condition holds, false when it does not within so many seconds.
template <class Condition>
bool wait_for(double seconds, Condition when) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!when()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
}

}  // namespace lamella
