// Repairs before printing: joins pieces, and counts the repairs of outlines.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "recipe/build/build_job.h"

namespace lamella {

struct RepairOptions : PassControl {};

/// Joins the pieces of the job as [repair] says, counts the places that make_processed repairs, and trims
/// or holds what hangs; the report is stored in `built`. Passes over all layers once for each requested
/// repair, twice to join pieces. Throws InputError when there are too many pieces, Interrupted when
/// cancelled.
void repair_job(const Recipe& recipe, BuiltJob& built, const RepairOptions& options);

/// Returns the height up to which tips that begin in the air are trimmed, mm: the recipe's, or the usual one.
double trim_height(const Recipe& recipe);

/// Returns the diameter of the struts below tips that stay, mm: the recipe's, or the usual one.
double hold_diameter(const Recipe& recipe);

/// Returns a solid without the tips that repair_job() trims of the job's part.
FieldPtr without_tips(FieldPtr solid, const BuiltJob& built);

/// Returns counts, sizes and places.
nlohmann::ordered_json repairs_json(const RepairReport& report);
/// Returns a line for each requested repair.
std::string repairs_text(const RepairReport& report);

}  // namespace lamella
