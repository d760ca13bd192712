// What every command that computes layers does before them: the job's options, its surveys and supports.
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
    std::vector<std::string> beside;  ///< other inputs on the same plate
    int threads = 0;
    int look_ahead = 0;
    bool resume = false;
    bool quiet = false;
};

/// Adds those options to a subcommand that look ahead of all layers: threads and plans.
void add_survey_options(CLI::App& command, JobOptions& options);
/// Adds all of them.
void add_job_options(CLI::App& command, JobOptions& options);

struct PreparedJob {
    BuiltJob built;
    StreamOptions stream;  ///< without its on_progress
};

/// Builds the job of a recipe with all that stands beside it, and says on standard error what a user should
/// know of it. Throws InputError for what cannot be made, Interrupted when cancelled.
PreparedJob prepare_job(const JobOptions& options, const Recipe& recipe, const CancelToken& cancel);

/// Finishes a built job, with the progress of its surveys and what they led to on standard error unless
/// quiet.
SupportStructures finish_with_progress(const Recipe& recipe, BuiltJob& built, const JobOptions& options,
                                       const CancelToken& cancel);

/// The command line that continues this run.
std::string resuming(const std::vector<std::string>& arguments);

}  // namespace lamella
