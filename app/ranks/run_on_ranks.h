// A command whose work several processes share: which of them does what, and how all of them end.
#pragma once

#include <functional>
#include <string>

#include "app/ranks/ranks.h"

namespace lamella {

/// What the process does that speaks to the user: the first of several, or the only one (null). Returns which
/// constraints the result violates, in words; none where it is as it should be.
using LeadRanks = std::function<std::string(Ranks* others)>;

/// What each of the other processes does, without a word: what fails is told to the first.
using HelpRank = std::function<void(Ranks& ranks)>;

/// Runs a command on its own, or as the rank that mpirun has made this process. Throws ConstraintError for
/// what is violated once all ranks have done their work. What else the leading process throws is said by it
/// and ends all processes with its exit code, since the others wait for it and would for ever.
void run_on_ranks(const LeadRanks& lead, const HelpRank& run_worker);

}  // namespace lamella
