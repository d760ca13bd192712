// OrientationFigures: what printing a body with one of its directions upward costs, from a sampled surface.
#pragma once

#include <utility>
#include <vector>

#include "engine/base/cancel_token.h"
#include "engine/field/field.h"
#include "procedural/texture/surface_sites.h"

namespace lamella {

/// Points of a body's surface, each with the area that it stands for. Edges take half a spacing from the
/// faces beside them.
struct SurfaceCover {
    SurfaceSites sites;
    std::vector<double> areas;  ///< mm^2
};

/// Samples the surface of a body with about `sites` points. Throws InputError for an empty or unbounded body,
/// Interrupted when cancelled.
SurfaceCover cover_surface(const Field& body, std::size_t sites, const CancelToken* cancel);

/// What needs supports, and what these are made of. Lengths in mm.
struct OrientationRules {
    double overhang = 1;      ///< that holds itself: horizontal mm for each mm of height
    double spacing = 3;       ///< of support points
    double connector = 0;     ///< height of the thin tip between a pillar and the part
    double tip_area = 0;      ///< of the tip's cross-section, mm^2
    double pillar_area = 1;   ///< of the cross-section of the pillar below it, mm^2
    double foot_volume = 0;   ///< of a pillar on the bed that is at least as high as its foot is wide, mm^3
    double foot_width = 0;    ///< lower pillars have a smaller one
    double lift = 0;          ///< of the part above the bed
    double layer_height = 0;  ///< surfaces that lie lower rest on the bed
};

struct OrientationFigures {
    dvec3 up{0, 0, 1};          ///< unit vector
    double support_volume = 0;  ///< estimate: a pillar below each spacing's square of overhang, mm^3
    double overhang_area = 0;   ///< surface that needs supports, mm^2
    double height = 0;          ///< mm
    double bed_area = 0;        ///< surface that lies on the bed, mm^2
    double largest_layer = 0;   ///< area of the largest horizontal section, mm^2
};

/// Returns two unit vectors at right angles to a third, `n`, and to each other (Duff et al., "Building an
/// Orthonormal Basis, Revisited", 2017).
std::pair<dvec3, dvec3> across(dvec3 n);

/// Returns the figures of a body that is printed along `up`, a unit vector. An overhang's pillar goes down to
/// the surface below it, or to the bed. Sections follow from the surface below them: by the divergence
/// theorem, their area is the flux of `up` through it.
OrientationFigures orientation_figures(const SurfaceCover& cover, dvec3 up, const OrientationRules& rules);

}  // namespace lamella
