// What fails on one of several ranks is told to the first, which ends the run.
#pragma once

#include <functional>

#include "app/ranks/ranks.h"

namespace lamella {

/// Does a rank's part of the work. What it throws is told to rank 0, but for Interrupted, which is thrown on:
/// all ranks are stopped at once.
void tell_failures(Ranks& ranks, const std::function<void()>& work);

/// On rank 0: throws what another rank has told, if one has, with the rank before its words. An Error of the
/// same exit code; FaultError for what is none.
void throw_failure(Ranks& ranks);

}  // namespace lamella
