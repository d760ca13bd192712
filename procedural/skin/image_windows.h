// ImageWindows: a picture's struts on a surface, projected along the axis that the surface faces most.
#pragma once

#include "procedural/skin/strut_image.h"
#include "procedural/skin/surface_charts.h"
#include "procedural/skin/window_pattern.h"

namespace lamella {

/// The picture tiles the three coordinate planes, upright and readable from outside, with its lower left
/// corner at the body's. Each point of the surface shows the plane that it faces most (triplanar projection).
/// Along the seams between planes runs a strut; its parts on both sides together are one minimum strut width
/// wide.
class ImageWindows : public WindowPattern {
  public:
    /// `depth` is how far from the surface the pattern is wanted, mm. Throws InputError as SurfaceCharts
    /// does.
    ImageWindows(StrutImage image, const Field& body, double strut, double depth);

    double value_near(dvec3 p, std::uint32_t& hint) const override;
    const StrutImage& image() const { return image_; }

  private:
    StrutImage image_;
    double half_strut_;  ///< half the strut width, mm
    Box bounds_;         ///< of the body
    SurfaceCharts charts_;
};

}  // namespace lamella
