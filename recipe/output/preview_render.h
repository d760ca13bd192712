// Shaded pictures of implicit solids, ray-cast from slices without a mesh.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "engine/base/picture.h"
#include "recipe/output/coverage_grid.h"
#include "recipe/output/cut_face.h"
#include "recipe/output/preview_options.h"

namespace lamella {

/// What a scene is made for.
struct SceneOptions {
    int pixels = 1024;          ///< longer side of the pictures for which the scene is fine enough
    int threads = 0;            ///< 0: one a core
    std::optional<Box> region;  ///< where the solids are looked at; empty: the whole bounds
};

/// A part and its supports (null for none), sliced once and drawn from any side:
///
///     const PreviewScene scene(part, supports, bounds, {.pixels = 512});
///     for (view.azimuth = 0; view.azimuth < 360; view.azimuth += 5) show(scene.render(view, &cancel));
///
/// Memory: 1.4 bytes a cell; cells are about 1.7 px wide, and at most 96 million up to 1024 px, 400 million
/// for larger pictures. Any thread may render.
class PreviewScene {
  public:
    /// Slices the solids within `bounds` (finite, not empty). Throws Interrupted when cancelled.
    PreviewScene(FieldPtr part, FieldPtr supports, const Box& bounds, const SceneOptions& options,
                 const CancelToken* cancel = nullptr);

    /// Draws a perspective view of the part and, in another colour, its supports on a light ground. The face
    /// of a cut is sliced by the first view that shows it. Throws Interrupted within milliseconds when
    /// cancelled.
    Picture render(const PreviewOptions& view, const CancelToken* cancel = nullptr) const;

  private:
    Picture draw(const PreviewOptions& view, const CancelToken* cancel) const;
    std::shared_ptr<const CutFace> face_of(const PreviewCut& plane, const CancelToken* cancel) const;

    TwoSolids solids_;
    Box bounds_;
    std::unique_ptr<const CoverageGrid> grid_;
    std::vector<dvec3> places_;  ///< where there is anything
    /// The face of the last cut: a function of the plane, kept for views that share it.
    mutable std::mutex mutex_;
    mutable std::shared_ptr<const CutFace> face_;
    mutable PreviewCut face_plane_;
};

/// Makes a scene and draws one view of it.
Picture render_preview(const FieldPtr& part, const FieldPtr& supports, const Box& bounds,
                       const PreviewOptions& options, const CancelToken* cancel = nullptr);

}  // namespace lamella
