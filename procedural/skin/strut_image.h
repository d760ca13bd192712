// StrutImage: a picture converted into a network of struts of a minimum width that tiles the plane.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/geometry.h"
#include "procedural/volume/volume.h"

namespace lamella {

struct StrutImageSettings {
    double size = 10;        ///< width of the picture, mm
    double strut = 0.5;      ///< minimum width of a strut, mm
    double threshold = 0.5;  ///< grey level, 0 to 1; darker is solid
    bool invert = false;     ///< lighter is solid instead
};

/// The solid part of a picture, tiled. The picture is interpolated bilinearly, at a resolution of up to an
/// eighth of a strut, and thresholded. A solid part narrower than a strut is widened about its medial line if
/// it is a strut: if it ends more than half a strut away from the parts that are wide enough, or joins two
/// places of them. Otherwise it is a mere corner and is rounded. Notches of windows narrower than half a
/// strut are filled. The result is a union of discs of one strut's diameter. Components that do not connect
/// to their own copies in other tiles would be loose inside a window; they are dropped.
class StrutImage {
  public:
    /// Throws InputError for settings out of range, for a stack of several pictures, and for a picture
    /// without windows or without struts that continue from tile to tile.
    StrutImage(const Volume& picture, const StrutImageSettings& settings);

    /// Returns a bound of the signed distance from a point to the border of the struts, mm; negative in a
    /// strut. The picture's lower left corner is the origin. 1-Lipschitz.
    double value(double u, double v) const;

    dvec2 tile() const { return {width_ * pixel_, height_ * pixel_}; }  ///< size, mm
    std::size_t islands() const { return islands_; }                    ///< components dropped per tile
    double open_share() const { return open_share_; }

  private:
    int width_ = 0, height_ = 0;   ///< of the refined raster
    double pixel_ = 1;             ///< mm
    std::vector<float> distance_;  ///< signed, px, at pixel centres; lowest row first
    std::size_t islands_ = 0;
    double open_share_ = 0;
};

}  // namespace lamella
