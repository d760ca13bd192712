// Which job an unfinished output belongs to, so that only the same job continues it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/layers/backend.h"

namespace lamella {

/// Two runs with equal stamps write the same bytes.
struct JobStamp {
    std::string identity;  ///< Job::identity
    std::string settings;  ///< what the back-end adds to it: its profile
    LayerRange range;
};

nlohmann::ordered_json to_json(const JobStamp& stamp);

/// Throws InputError, naming `where` and the first difference, unless `found` describes the same job.
void check_same_job(const nlohmann::ordered_json& found, const JobStamp& wanted,
                    const std::filesystem::path& where);

/// What is wrong with a range that a job does not have; throws InputError.
void check_range(const Job& job, LayerRange range);

}  // namespace lamella
