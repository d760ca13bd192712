// Struts below tips: from what begins in the air straight down to the part, within its body.
#pragma once

#include <optional>

#include "engine/field/field.h"
#include "engine/solids/beam.h"

namespace lamella {

struct TipStrutOptions {
    double radius = 0.4;         ///< of a strut where it holds the tip, mm; half of it at its foot
    double layer_height = 0.05;  ///< mm: the part below the tip's first layer is no part of the tip
    double reach = 8;            ///< longest strut, mm
};

/// Returns the shortest strut from a tip down to the part, at most 45 degrees off the vertical, so that each
/// of its layers lies on the one below. Its centre line stays in the body, and its foot stands in solid at
/// least as deep as the radius. The direction is the best of 65. Returns nothing when none reaches the part.
/// `tip` lies in the first layer of what begins in the air.
std::optional<Beam> strut_below(dvec3 tip, const Field& part, const Field& body,
                                const TipStrutOptions& options);

}  // namespace lamella
