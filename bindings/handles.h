// Definitions of the opaque types of lamella.h.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bindings/context.h"
#include "engine/contours/contours.h"
#include "engine/layers/layer_stream.h"
#include "recipe/build/build_job.h"
#include "recipe/machine_profiles.h"
#include "recipe/recipe_draft.h"

struct lamella_cancel {
    lamella::CancelToken token;
};

struct lamella_recipe {
    lamella::RecipeDraft draft;
    lamella::MachineProfiles profiles;
    std::vector<std::pair<const lamella::Setting*, std::string>> set;  ///< precedence over the draft's values
};

struct lamella_job {
    lamella::Recipe recipe;
    lamella::MachineProfiles profiles;
    lamella::Job job;
    lamella::BuiltJob built;  ///< what the job was made of; its own job has been moved out
};

/// A section. One that was opened at a height owns its slices; that of a layer in flight borrows the layer's.
struct lamella_section {
    std::vector<lamella::FieldPtr> parts;  ///< keeps the cut fields alive; empty for a layer in flight
    std::unique_ptr<lamella::SliceContext> context;
    lamella::Scratch scratch;
    const lamella::SliceField* part = nullptr;
    const lamella::SliceField* supports = nullptr;  ///< null when there are none
    lamella_section_info info{};
};

struct lamella_runs {
    std::vector<std::size_t> first;
    std::vector<std::int32_t> ends;
};

struct lamella_contours {
    std::vector<std::size_t> first;
    std::vector<double> points;
    std::vector<std::int32_t> parents;
    double area = 0;
};

namespace lamella {

/// Returns a function that passes progress to the caller's callback, which may stop the work; empty without a
/// callback.
std::function<void(const char* what, const Progress&)> progress_to(lamella_on_progress callback, void* user);

/// Makes `section` borrow the slices of a layer in flight.
void lend_layer(const Layer& layer, lamella_section& section);

lamella_job_info job_info(const Job& job);

}  // namespace lamella
