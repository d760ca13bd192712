// Exemplar: a picture of solid and void whose look a pattern takes over, at the resolution of its sites.
#pragma once

#include <cstdint>
#include <vector>

#include "procedural/appearance/grey_image.h"

namespace lamella {

/// Solid and void at the resolution of one grid of sites.
struct Exemplar {
    /// Distances beyond this many pixels look alike.
    static constexpr double reach = 4;

    GreyImage solid;  ///< solid share of each pixel
    /// Signed distance from the border: 0.5 on it, 1 in the solid, `reach` pixels away and farther, 0 in the
    /// void.
    GreyImage distance;
};

/// Returns what of a picture in black and white is solid, scaled to `width` pixels across; see
/// black_and_white(). The distance (the feature distance of Lefebvre and Hoppe 2006, "Appearance-space
/// texture synthesis") keeps lines alive that are thinner than a pixel. Beyond the picture, its border goes
/// on. Throws InputError for a width that is larger than the picture's.
Exemplar make_exemplar(const GreyImage& black_and_white, int width);

/// Returns the mean of the values.
double mean_of(const GreyImage& image);

}  // namespace lamella
