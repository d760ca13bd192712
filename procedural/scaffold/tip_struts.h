// Struts below tips: from what begins in the air down to the part or to the bed, within its body.
#pragma once

#include <optional>
#include <vector>

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

/// Returns a strut from a tip close above the bed to the bed, within the body: sideways, as flat as the body
/// itself leaves the bed, and in several legs where the straight way leaves the body. Its foot is as thick as
/// its tip, and lies where the body reaches down to the bed: the nearest such place on a grid of an eighth of
/// the radius, up to twelve radii away. Returns no leg when the tip is higher above the bed than half the
/// radius, or no such place lies within reach. `first_plane` is the height of the lowest layer's cutting
/// plane, mm; half a layer lies below it.
std::vector<Beam> struts_to_bed(dvec3 tip, double first_plane, const Field& body,
                                const TipStrutOptions& options);

/// Returns a level strut from a tip to the nearest solid of the part that goes on below it for a radius,
/// within the body and no farther away than struts_to_bed() looks. It hangs over what it crosses.
std::vector<Beam> struts_aside(dvec3 tip, const Field& part, const Field& body,
                               const TipStrutOptions& options);

}  // namespace lamella
