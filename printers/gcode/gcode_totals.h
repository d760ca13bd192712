// GcodeTotals: what the lines of a job take, and the facts about it at the end of a file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"
#include "printers/gcode/motion_model.h"

namespace lamella {

/// Lengths of filament in mm.
struct GcodeTotals {
    std::vector<double> filament;  ///< extruded, by tool
    double support_filament = 0;   ///< share of supports in it
    double seconds = 0;            ///< by the motion model
    double slowed = 0;             ///< length of extrusion slowed down for the rate of lines, mm
    std::int64_t islands_left_out = 0;
};

/// Returns the comments that hosts and previewers look for at the end of a file, and a summary of the job.
/// Filament is listed by tool, as slicers do. The supports' share is told where `has_supports`, and where one
/// tool makes all.
std::string facts_text(const GcodeTotals& totals, const PrinterProfile& profile, const RateMeter& rate,
                       bool has_supports, LayerRange range, double layer_height);

}  // namespace lamella
