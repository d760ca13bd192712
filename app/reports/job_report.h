// What a finished job holds: its facts, and the areas of its masks.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "printers/readers/read_job.h"

namespace lamella {

/// Lit areas of all masks, mm^2, or pixels where the job does not tell their size. A grey pixel counts by its
/// grey.
struct AreaSummary {
    double lowest = 0, highest = 0, mean = 0;
    int lowest_layer = 0, highest_layer = 0;
    int empty_layers = 0;
    bool in_pixels = false;
};

/// Decodes every mask, several at once (0 threads: one a core). Throws InputError for one that is damaged.
AreaSummary measure_areas(const JobFile& job, int threads, bool quiet);

/// What the masks make, mm^3; negative where the job does not tell sizes.
double mask_volume(const JobFacts& facts, const AreaSummary& areas);

nlohmann::ordered_json job_json(const std::string& path, const JobFacts& facts, const AreaSummary& areas);
std::string job_text(const JobFacts& facts, const AreaSummary& areas);

}  // namespace lamella
