// A wait that a cancel token ends.
#pragma once

#include "engine/base/cancel_token.h"

namespace lamella {

/// Waits for this time, s. Throws Interrupted when cancelled; `cancel` may be null.
void wait_for(double seconds, const CancelToken* cancel);

}  // namespace lamella
