// Preparation shared by all commands that compute layers: options, surveys, supports and plates.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/commands/recipe_options.h"
#include "engine/layers/layer_stream.h"
#include "recipe/build/build_job.h"
#include "recipe/build/finish_job.h"

namespace lamella {

struct JobOptions {
    RecipeOptions recipe;
    std::string layers;  ///< A:B
    std::string plans = default_plan_folder();
    std::vector<std::string> beside;  ///< other inputs printed on the same plate
    int threads = 0;
    int look_ahead = 0;
    bool resume = false;
    bool quiet = false;
};

/// Adds the options of surveys to a subcommand: threads and plans.
void add_survey_options(CLI::App& command, JobOptions& options);
/// Adds all options of JobOptions.
void add_job_options(CLI::App& command, JobOptions& options);

/// Returns the options for building a job whose results are kept in the user's plan folder. Unless quiet, a
/// line on standard error says when the pattern of a skin is being computed.
OptimizeOptions with_kept_plans(bool quiet);

struct PreparedJob {
    BuiltJob built;
    StreamOptions stream;  ///< without on_progress
};

/// Builds the job of a recipe together with the inputs on the same plate, and prints warnings on standard
/// error. Throws InputError when something cannot be made, Interrupted when cancelled.
PreparedJob prepare_job(const JobOptions& options, const Recipe& recipe, const CancelToken& cancel);

/// Finishes a built job (see finish_job); reports the progress of its surveys and their results on standard
/// error unless quiet.
SupportStructures finish_with_progress(const Recipe& recipe, BuiltJob& built, const JobOptions& options,
                                       const CancelToken& cancel);

/// Returns the command line that continues this run.
std::string resuming(const std::vector<std::string>& arguments);

}  // namespace lamella
