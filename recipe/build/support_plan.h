// The plan of supports, kept on disk under the hash of what decides it: shards, resumed runs and pictures of
// one job share it.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "engine/surveys/overhang_survey.h"
#include "procedural/scaffold/scaffold.h"

namespace lamella {

/// What must be held, and what holds it. The scaffold's shape is not part of the plan's file: the recipe says
/// it.
struct SupportPlan {
    OverhangSurvey survey;
    Scaffold scaffold;
};

/// Where plans are kept unless told otherwise: lamella/plans in the user's cache ($XDG_CACHE_HOME, or else
/// ~/.cache); empty where there is neither.
std::filesystem::path default_plan_folder();

/// The survey's figures and the scaffold's pieces; numbers read back exactly.
nlohmann::ordered_json plan_json(const SupportPlan& plan);

/// The plan of that hash in the folder; nothing when there is none, or its file is damaged.
std::optional<SupportPlan> read_plan(const std::filesystem::path& folder, const std::string& hash);

/// Keeps a plan; its file appears complete or not at all. False where the folder cannot be written to.
bool keep_plan(const std::filesystem::path& folder, const std::string& hash, const SupportPlan& plan);

}  // namespace lamella
