// Pictures of a job: the part as it was designed, and what holds it.
#pragma once

#include <optional>

#include "recipe/build/build_supports.h"
#include "recipe/output/preview_render.h"

namespace lamella {

/// The part and its supports (nothing for none) before layers are offset, as render_preview draws them.
Picture render_job(const Recipe& recipe, const BuiltJob& built, const std::optional<BuiltSupports>& supports,
                   const PreviewOptions& options);

/// Gives the job its picture, drawn when a back-end asks for it. `threads` as in PreviewOptions.
void add_picture(const Recipe& recipe, BuiltJob& built, const std::optional<BuiltSupports>& supports,
                 int threads);

}  // namespace lamella
