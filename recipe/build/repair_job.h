// Repairs before a part is printed: pieces joined, and what of its outlines is mended.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "recipe/build/build_job.h"

namespace lamella {

struct RepairOptions : PassControl {};

/// Joins the pieces of the job as [repair] asks, and counts what make_processed mends: the report stands in
/// `built` then. Looks at all layers, for each of the repairs asked for. Throws InputError when there are too
/// many pieces, Interrupted when cancelled.
void repair_job(const Recipe& recipe, BuiltJob& built, const RepairOptions& options);

/// Counts, sizes and places.
nlohmann::ordered_json repairs_json(const RepairReport& report);
/// A line for each repair that was asked for.
std::string repairs_text(const RepairReport& report);

}  // namespace lamella
