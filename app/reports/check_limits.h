// Derives the limits of a print check from a machine and a job.
#pragma once

#include <string>
#include <vector>

#include "engine/checks/print_check.h"
#include "printers/process_limits.h"
#include "recipe/recipe.h"

namespace lamella {

/// The plan of a print check for one machine.
struct CheckPlan {
    Process process = Process::from_backend;  ///< never from_backend in a plan: the resolved process
    PrintCheckOptions options;
    std::vector<std::string> notes;  ///< remarks on the limits for the user, a sentence each
};

/// Plans the check of a job for a machine: limits of the process, printable overhang, build volume, and
/// pitch. `parts`: number of parts on the plate; if there are several, connectivity is not checked. Throws
/// InputError when the machine's back-end is unknown.
CheckPlan plan_check(const PrinterProfile& printer, const Job& job, int parts);

}  // namespace lamella
