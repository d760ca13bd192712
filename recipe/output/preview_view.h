// PreviewView: what one ray of a picture meets, and its light.
#pragma once

#include <memory>
#include <optional>

#include "recipe/output/coverage_grid.h"
#include "recipe/output/cut_face.h"
#include "recipe/output/preview_camera.h"

namespace lamella {

/// What a ray meets. `ground` includes the sky.
enum class Seen : unsigned char { ground, part, second, part_cut, second_cut };

/// A point of the picture's surfaces.
struct PreviewHit {
    Seen seen = Seen::ground;
    double depth = infinity;  ///< cells along the ray
    dvec3 point{0};
    dvec3 normal{0};  ///< towards the eye
};

/// The scene from one eye. Positions are in cells of the grid. Immutable; any thread may query it.
class PreviewView {
  public:
    /// The grid must outlive the view; `face` is null when nothing is cut.
    PreviewView(const CoverageGrid& grid, std::shared_ptr<const CutFace> face, const PreviewCut& cut,
                const PreviewCamera& camera, const Box& bounds, const PreviewOptions& options);

    /// Returns what the ray through a point of the picture meets at or after a depth.
    PreviewHit trace(dvec3 direction, double from = 0) const;
    /// Returns the linear light of a hit that is not ground.
    dvec3 shade(const PreviewHit& hit, dvec3 direction) const;
    /// Returns the light of the sky or of unshadowed ground at a height of the picture, -1 to 1.
    dvec3 backdrop(double y) const;
    /// Returns the share of that light which shadows leave.
    double ground_light(dvec3 direction) const;

    dvec3 ray(double x, double y) const { return camera_.ray(x, y); }
    bool smooth() const { return options_.smooth; }

  private:
    std::optional<PreviewHit> cut_hit(dvec3 direction, double t) const;
    double openness(dvec3 p, dvec3 n, double reach) const;
    dvec3 colour_of(const PreviewHit& hit) const;

    const CoverageGrid& grid_;
    std::shared_ptr<const CutFace> face_;
    PreviewCut cut_mm_, cut_;  ///< in mm, and in cells
    PreviewCamera camera_;
    dvec3 eye_;
    double ground_;  ///< height of the ground
    Box inside_;     ///< cells that rays cross
    dvec3 key_;      ///< direction towards the light
    double reach_;
    PreviewOptions options_;
};

}  // namespace lamella
