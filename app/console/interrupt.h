// Ctrl-C: signals that ask a run to stop cleanly.
#pragma once

#include "engine/layers/layer_stream.h"

namespace lamella {

/// While it lives, the first SIGINT or SIGTERM sets the token; a second one ends the process at once. Only
/// one may exist at a time.
class InterruptGuard {
  public:
    explicit InterruptGuard(CancelToken& token);
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
};

}  // namespace lamella
