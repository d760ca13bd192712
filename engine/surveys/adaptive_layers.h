// Adaptive layers: heights that follow the slope of the surface.
#pragma once

#include <vector>

#include "engine/surveys/slope_survey.h"

namespace lamella {

/// Limits of layers that adapt, mm.
struct AdaptiveLimits {
    double least = 0.1, most = 0.3;  ///< heights of a layer
    double cusp = 0.1;               ///< largest distance between a layer's step and the surface
    /// Heights over the solid's underside. Layers that begin there are at most this high, also where that is
    /// less than `least`; those below reach into them by less than `least`. Of bands that overlap, the last
    /// one holds.
    struct Band {
        Interval z;
        double most = 0;
    };
    std::vector<Band> bands{};
};

/// Returns the fewest layers, from `bottom` over a solid's underside to its top, whose cusps are within the
/// limit: a layer's cusp is its height times the greatest |z| of the surface's normals within it (Dolenc,
/// Makela, "Slicing procedures for layered manufacturing techniques", 1994, section 3). Level faces have none
/// where a layer ends at them, to half a grain. Of equally many layers, those that differ least in height
/// from each other win. Where even the least height is too much, the least is taken.
///
/// Heights are multiples of a grain: a twentieth of the least, in whole micrometres. Found by dynamic
/// programming over these heights. Throws InputError where there would be more than 20 million grains.
LayerPlan adapt_layers(const SlopeProfile& profile, const AdaptiveLimits& limits, double bottom, double top);

/// Returns the largest cusp of layers that begin `bottom` mm over the solid's underside, mm.
double greatest_cusp(const SlopeProfile& profile, const LayerPlan& layers, double bottom);

}  // namespace lamella
