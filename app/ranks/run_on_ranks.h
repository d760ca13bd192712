// Runs a command whose work several processes share, and ends all of them.
#pragma once

#include <functional>
#include <string>

#include "app/ranks/ranks.h"

namespace lamella {

/// The work of rank 0, or of a single process (null), which alone writes messages. Returns the violated
/// constraints in words; empty for none.
using LeadRanks = std::function<std::string(Ranks* others)>;

/// The work of each other process, which writes no messages: its failures are reported to rank 0.
using HelpRank = std::function<void(Ranks& ranks)>;

/// Runs a command alone, or as this process's rank under mpirun. Throws ConstraintError for violated
/// constraints after all ranks have finished. Rank 0 prints any other exception of its own and ends all
/// processes with its exit code, because the others would wait for it for ever.
void run_on_ranks(const LeadRanks& lead, const HelpRank& run_worker);

}  // namespace lamella
