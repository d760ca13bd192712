// In steps of at most a twentieth of a second.
#include "hosts/wait.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace lamella {

void wait_for(double seconds, const CancelToken* cancel) {
    using Clock = std::chrono::steady_clock;
    const auto until =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    while (Clock::now() < until) {
        stop_if_cancelled(cancel);
        std::this_thread::sleep_for(
            std::min<Clock::duration>(until - Clock::now(), std::chrono::milliseconds(50)));
    }
    stop_if_cancelled(cancel);
}

}  // namespace lamella
