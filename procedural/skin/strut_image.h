// StrutImage: a picture made into a network of struts of a least width, repeated over the plane.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/geometry.h"
#include "procedural/volume/volume.h"

namespace lamella {

struct StrutImageSettings {
    double size = 10;        ///< mm that the picture's width covers
    double strut = 0.5;      ///< least width of a strut, mm
    double threshold = 0.5;  ///< grey, 0 to 1, below which the picture is solid
    bool invert = false;     ///< solid above it instead
};

/// The solid part of a picture, tiled. The picture is read between its pixels by bilinear interpolation, as
/// finely as an eighth of a strut, and thresholded. What is solid and narrower than a strut is widened about
/// its middle line when it is a strut, that is when it ends more than half a strut away from what is wide
/// enough or joins two places of that; a mere corner is rounded instead. Notches of windows narrower than
/// half a strut are filled. So the solid part is a union of discs that are a strut wide. Parts of it that are
/// no network, because they do not go on over the tile's border round to themselves, would float free in a
/// window and are left out.
class StrutImage {
  public:
    /// Throws InputError for settings out of range, a stack of several pictures, a picture without struts
    /// that go on, or without windows.
    StrutImage(const Volume& picture, const StrutImageSettings& settings);

    /// Bounds the distance from the place (mm; the picture's lower left corner is the origin) to where struts
    /// end or begin; negative in a strut. Changes by at most 1 per mm.
    double value(double u, double v) const;

    dvec2 tile() const { return {width_ * pixel_, height_ * pixel_}; }  ///< mm
    std::size_t islands() const { return islands_; }                    ///< left out of a tile
    double open_share() const { return open_share_; }

  private:
    int width_ = 0, height_ = 0;   ///< of the finer raster
    double pixel_ = 1;             ///< mm
    std::vector<float> distance_;  ///< signed, px, at the middles of pixels; rows from below
    std::size_t islands_ = 0;
    double open_share_ = 0;
};

}  // namespace lamella
