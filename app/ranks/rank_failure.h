// Reports failures of other ranks to rank 0, which ends the run.
#pragma once

#include <functional>

#include "app/ranks/ranks.h"

namespace lamella {

/// Does a rank's part of the work. Sends exceptions to rank 0, except Interrupted, which it rethrows: an
/// interruption stops all ranks at once.
void tell_failures(Ranks& ranks, const std::function<void()>& work);

/// On rank 0: throws the failure that another rank has reported, if any, with the rank before its message.
/// InputError and ConstraintError keep their types; all others become FaultError.
void throw_failure(Ranks& ranks);

}  // namespace lamella
