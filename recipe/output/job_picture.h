// Pictures of a job: the designed part and its supports.
#pragma once

#include <memory>
#include <optional>

#include "recipe/build/build_supports.h"
#include "recipe/output/preview_render.h"

namespace lamella {

/// Renders the part and its supports (nothing for none) before in-plane offsets, with render_preview.
Picture render_job(const Recipe& recipe, const BuiltJob& built, const std::optional<BuiltSupports>& supports,
                   const PreviewOptions& options);

/// Makes a scene of the same, to be drawn from several sides.
std::unique_ptr<const PreviewScene> make_scene(const Recipe& recipe, const BuiltJob& built,
                                               const std::optional<BuiltSupports>& supports,
                                               const SceneOptions& options);

/// Gives the job its picture, which is drawn when a back-end asks for it. `threads` as in PreviewOptions.
void add_picture(const Recipe& recipe, BuiltJob& built, const std::optional<BuiltSupports>& supports,
                 int threads);

}  // namespace lamella
