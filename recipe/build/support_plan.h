// SupportPlan: the plan of supports, cached on disk under the hash of its inputs, so that shards, resumed
// runs and pictures of one job share it.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "engine/surveys/overhang_survey.h"
#include "procedural/scaffold/scaffold.h"

namespace lamella {

/// The surveyed overhangs, and the scaffold that supports them. The scaffold's cross-sections are not part of
/// the file: they follow from the recipe.
struct SupportPlan {
    OverhangSurvey survey;
    Scaffold scaffold;
};

/// Returns the default folder for plans: lamella/plans in the user's cache ($XDG_CACHE_HOME, or else
/// ~/.cache); empty when there is neither.
std::filesystem::path default_plan_folder();

/// Returns the survey's figures and the scaffold's pieces; numbers are written so that they read back
/// exactly.
nlohmann::ordered_json plan_json(const SupportPlan& plan);

/// Reads the plan with that hash from the folder; returns nothing when there is none or its file is damaged.
std::optional<SupportPlan> read_plan(const std::filesystem::path& folder, const std::string& hash);

/// Writes a plan; its file appears complete or not at all. Returns false when the folder cannot be written
/// to.
bool keep_plan(const std::filesystem::path& folder, const std::string& hash, const SupportPlan& plan);

}  // namespace lamella
