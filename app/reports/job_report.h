// Report on a finished job file: its facts, and the areas of its masks.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "printers/readers/read_job.h"

namespace lamella {

/// Statistics of the lit areas of all masks, mm^2, or pixels when the job does not state their size. A grey
/// pixel counts by its grey value.
struct AreaSummary {
    double lowest = 0, highest = 0, mean = 0;
    double volume = 0;  ///< areas times heights, where heights of layers differ
    int lowest_layer = 0, highest_layer = 0;
    int empty_layers = 0;
    bool in_pixels = false;
};

/// Decodes every mask, several in parallel (0 threads: one per core). Throws InputError for a damaged mask.
AreaSummary measure_areas(const JobFile& job, int threads, bool quiet);

/// Returns the volume that the masks make, mm^3; negative when the job does not state sizes.
double mask_volume(const JobFacts& facts, const AreaSummary& areas);

nlohmann::ordered_json job_json(const std::string& path, const JobFacts& facts, const AreaSummary& areas);
std::string job_text(const JobFacts& facts, const AreaSummary& areas);

}  // namespace lamella
