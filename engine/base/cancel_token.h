// CancelToken: asks long work to stop.
#pragma once

#include <atomic>

#include "engine/base/error.h"

namespace lamella {

/// A flag that asks long work to stop. Safe to set from any thread and from a signal handler.
class CancelToken {
  public:
    void cancel() { flag_.store(true, std::memory_order_relaxed); }
    bool cancelled() const { return flag_.load(std::memory_order_relaxed); }

  private:
    std::atomic<bool> flag_{false};
};

/// Throws Interrupted when the token is cancelled; a null token never is. Long work calls this every few
/// milliseconds.
inline void stop_if_cancelled(const CancelToken* cancel) {
    if (cancel != nullptr && cancel->cancelled()) throw Interrupted("stopped");
}

}  // namespace lamella
