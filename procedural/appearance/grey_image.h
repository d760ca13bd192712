// GreyImage: an image of one channel in [0, 1], 1 = solid; made from a picture, scaled to a grid of elements.
#pragma once

#include <cstddef>
#include <vector>

#include "procedural/volume/volume.h"

namespace lamella {

/// Values row by row, x fastest, the lowest row first: y points upward.
struct GreyImage {
    int width = 0;   ///< px
    int height = 0;  ///< px
    std::vector<double> values;

    GreyImage() = default;
    GreyImage(int w, int h, double value = 0)
        : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

/// Returns how solid each pixel of a picture is, see read_picture(): 1 - luma, so black is solid; the luma
/// with `invert`. Throws InputError for a picture without pixels or with several pages.
GreyImage solidity(const Volume& picture, bool invert = false);

/// Returns the image at `width` pixels across and in its proportions, at least one pixel high. Each pixel is
/// the mean of the image over the pixel's area, so the mean of the whole is kept. Throws InputError for a
/// width below 1 and for an image without pixels.
GreyImage box_filtered(const GreyImage& image, int width);

/// Returns the threshold that best parts the values into two classes (Otsu 1979, A threshold selection method
/// from gray-level histograms), in steps of 1/256; 0.5 for an image of one value.
double otsu_threshold(const GreyImage& image);

/// Returns the image in black and white: 1 where it is `threshold` or more, 0 elsewhere.
GreyImage black_and_white(const GreyImage& image, double threshold = 0.5);

}  // namespace lamella
