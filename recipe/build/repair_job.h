// Repairs before printing: joins pieces, and counts the repairs of outlines.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "recipe/build/build_job.h"

namespace lamella {

struct RepairOptions : PassControl {};

/// Joins the pieces of the job as [repair] says, and counts the places that make_processed repairs; the
/// report is stored in `built`. Passes over all layers once for each requested repair. Throws InputError when
/// there are too many pieces, Interrupted when cancelled.
void repair_job(const Recipe& recipe, BuiltJob& built, const RepairOptions& options);

/// Returns counts, sizes and places.
nlohmann::ordered_json repairs_json(const RepairReport& report);
/// Returns a line for each requested repair.
std::string repairs_text(const RepairReport& report);

}  // namespace lamella
