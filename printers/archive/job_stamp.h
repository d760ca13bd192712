// JobStamp: identifies the job of an unfinished output, so that only the same job resumes it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/layers/backend.h"

namespace lamella {

/// Identity of a run. Two runs with equal stamps write the same bytes.
struct JobStamp {
    std::string identity;  ///< Job::identity
    std::string settings;  ///< settings of the back-end's profile that affect the bytes
    LayerRange range;
};

nlohmann::ordered_json to_json(const JobStamp& stamp);

/// Throws InputError, naming `where` and the first difference, unless `found` describes the same job.
void check_same_job(const nlohmann::ordered_json& found, const JobStamp& wanted,
                    const std::filesystem::path& where);

}  // namespace lamella
