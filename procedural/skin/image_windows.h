// ImageWindows: a picture's struts on a surface, seen along the axis that the surface faces most.
#pragma once

#include "procedural/skin/strut_image.h"
#include "procedural/skin/surface_charts.h"
#include "procedural/skin/window_pattern.h"

namespace lamella {

/// The picture tiles the three coordinate planes, upright and readable from outside, its lower left corner at
/// the body's; each place of the surface shows the plane that it faces most (triplanar projection). Where
/// planes change over runs a strut, as wide as the least one to either side of the seam together.
class ImageWindows : public WindowPattern {
  public:
    /// `depth`: how far from the surface the pattern is wanted, mm. Throws InputError for what the charts
    /// refuse.
    ImageWindows(StrutImage image, const Field& body, double strut, double depth);

    double value_near(dvec3 p, std::uint32_t& hint) const override;
    const StrutImage& image() const { return image_; }

  private:
    StrutImage image_;
    double half_strut_;  ///< mm
    Box bounds_;         ///< of the body
    SurfaceCharts charts_;
};

}  // namespace lamella
