// Camera of a picture, and the side of the part that is cut away for it.
#pragma once

#include <span>

#include "recipe/output/density_pyramid.h"
#include "recipe/output/preview_options.h"

namespace lamella {

struct PreviewCamera {
    dvec3 eye, forward, right, up;
    dvec2 shift{0};  ///< shift of the picture's centre that centres the part
    double reach;    ///< half the picture's shorter side at distance 1

    /// Returns the direction through a point of the picture; x and y from -1 to 1 across the shorter side.
    dvec3 ray(double x, double y) const {
        return glm::normalize(forward + right * (x * reach + shift.x) + up * (y * reach + shift.y));
    }
};

/// Returns a camera that sees all of the bounds.
PreviewCamera camera_before(const Box& bounds, const PreviewOptions& options);

/// Turns the camera and narrows its view until these points just fit the picture.
void zoom_to(PreviewCamera& camera, std::span<const dvec3> points, const PreviewOptions& options);

/// Returns the plane of the cut, mm: the part on the eye's side of it is removed, or what is not printed.
PreviewCut cut_plane(const Box& bounds, const PreviewOptions& options);

/// Returns what the cut leaves of the bounds.
Box kept_by(const PreviewCut& plane, const Box& bounds);

}  // namespace lamella
