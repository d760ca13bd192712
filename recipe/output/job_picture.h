// Pictures of a job: the designed part and its supports.
#pragma once

#include <optional>

#include "recipe/build/build_supports.h"
#include "recipe/output/preview_render.h"

namespace lamella {

/// Renders the part and its supports (nothing for none) before in-plane offsets, with render_preview.
Picture render_job(const Recipe& recipe, const BuiltJob& built, const std::optional<BuiltSupports>& supports,
                   const PreviewOptions& options);

/// Gives the job its picture, which is drawn when a back-end asks for it. `threads` as in PreviewOptions.
void add_picture(const Recipe& recipe, BuiltJob& built, const std::optional<BuiltSupports>& supports,
                 int threads);

}  // namespace lamella
