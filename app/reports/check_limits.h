// From a recipe and its job to what a print check holds the layers against.
#pragma once

#include <string>
#include <vector>

#include "engine/checks/print_check.h"
#include "printers/process_limits.h"
#include "recipe/recipe.h"

namespace lamella {

/// What a check of one machine looks for.
struct CheckPlan {
    Process process = Process::from_backend;  ///< never that: the machine's own
    PrintCheckOptions options;
    std::vector<std::string> notes;  ///< what a user should know of the limits, a sentence each
};

/// Plans the check of a job for a machine: the process's limits, what the job's layers may stand out by, the
/// machine's room, the pitch. `parts`: how many stand on the plate; of several none is asked to be joined to
/// the others. Throws InputError when the machine's back-end is unknown.
CheckPlan plan_check(const PrinterProfile& printer, const Job& job, int parts);

}  // namespace lamella
