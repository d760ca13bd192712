// OrientationFigures: what printing a body with one of its directions upward costs, from a sampled surface.
#pragma once

#include <utility>
#include <vector>

#include "procedural/orientation/surface_cover.h"

namespace lamella {

/// What needs supports, what these are made of, and what the part has to bear. Lengths in mm.
struct OrientationRules {
    double overhang = 1;        ///< that holds itself: horizontal mm for each mm of height
    double spacing = 3;         ///< of support points
    double connector = 0;       ///< height of the thin tip between a pillar and the part
    double tip_area = 0;        ///< of the tip's cross-section, mm^2
    double pillar_area = 1;     ///< of the cross-section of the pillar below it, mm^2
    double foot_volume = 0;     ///< of a pillar on the bed that is at least as high as its foot is wide, mm^3
    double foot_width = 0;      ///< lower pillars have a smaller one
    double lift = 0;            ///< of the part above the bed
    double layer_height = 0.2;  ///< above 0; surfaces that lie lower rest on the bed
    std::vector<dvec3> loads{};  ///< forces on the part in any unit; their signs do not matter
};

struct OrientationFigures {
    dvec3 up{0, 0, 1};          ///< unit vector
    double support_volume = 0;  ///< estimate: a pillar for each spacing of overhang, mm^3
    double overhang_area = 0;   ///< surface that needs supports, mm^2
    double height = 0;          ///< mm
    double bed_area = 0;        ///< surface that lies on the bed, mm^2
    double largest_layer = 0;   ///< area of the largest horizontal section, mm^2
    double largest_step = 0;    ///< largest difference between the areas of neighbouring layers, mm^2
    /// Distance of the centroid inside the convex hull of what touches the bed when the part is set down
    /// without supports, seen from above, mm; negative: outside, it topples. Low by up to one and a half of
    /// the distance of the points.
    double stands = 0;
    double load_across = 0;  ///< share of the loads across the layers, 0 to 1: sum |F up| / sum |F|
};

/// Returns two unit vectors at right angles to a third, `n`, and to each other (Duff et al., "Building an
/// Orthonormal Basis, Revisited", 2017).
std::pair<dvec3, dvec3> across(dvec3 n);

/// Returns the figures of a body that is printed along `up`, a unit vector. From the lowest overhang up, each
/// that no support holds yet gets one, which holds all within the spacing; its pillar goes down to the
/// surface below it, or to the bed. Sections follow from the surface below them: by the divergence theorem,
/// their area is the flux of `up` through it. Steps in area are told to about the share of the surface that a
/// layer's points stand for.
OrientationFigures orientation_figures(const SurfaceCover& cover, dvec3 up, const OrientationRules& rules);

}  // namespace lamella
