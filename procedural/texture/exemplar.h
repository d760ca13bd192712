// Exemplar: a picture of solid and void whose look a pattern takes over, at the resolution of its sites.
#pragma once

#include <cstdint>
#include <vector>

#include "procedural/appearance/grey_image.h"

namespace lamella {

/// A picture among those of an exemplar, from which the matches of one window are taken.
struct ExemplarPart {
    int first_row = 0, width = 0, height = 0;  ///< pixels
    double weight = 1;                         ///< mean over sites of how much they want it
};

/// Solid and void at the resolution of one grid of sites.
struct Exemplar {
    /// Distances beyond this many pixels look alike.
    static constexpr double reach = 4;

    GreyImage solid;  ///< solid share of each pixel
    /// Signed distance from the border: 0.5 on it, 1 in the solid, `reach` pixels away and farther, 0 in the
    /// void.
    GreyImage distance;
    /// One, or several on top of each other, as wide as the widest.
    std::vector<ExemplarPart> parts{};
    /// By site and part, from 0 to 1: how much a site wants to look like it; empty for one part.
    std::vector<float> weights{};

    /// Returns the part that a row belongs to.
    std::size_t part_of(int row) const {
        std::size_t part = 0;
        while (part + 1 < parts.size() && row >= parts[part + 1].first_row) ++part;
        return part;
    }
};

/// Returns what of a picture in black and white is solid, scaled to `width` pixels across; see
/// black_and_white(). The distance (the feature distance of Lefebvre and Hoppe 2006, "Appearance-space
/// texture synthesis") keeps lines alive that are thinner than a pixel. Beyond the picture, its border goes
/// on. Throws InputError for a width that is larger than the picture's.
Exemplar make_exemplar(const GreyImage& black_and_white, int width);

/// Returns an exemplar of several parts, with their weights by site and part. Throws InputError for fewer
/// than two, and for weights that are not of whole sites.
Exemplar stacked(const std::vector<Exemplar>& parts, std::vector<float> weights);

/// Returns the mean of the values.
double mean_of(const GreyImage& image);

}  // namespace lamella
