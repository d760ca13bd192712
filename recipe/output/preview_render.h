// A shaded picture of an implicit solid, straight from the field: no mesh is made.
#pragma once

#include <functional>

#include "engine/base/picture.h"
#include "engine/field/field.h"

namespace lamella {

struct PreviewOptions {
    int width = 1024;       ///< px
    int height = 1024;      ///< px
    double azimuth = 35;    ///< degrees, the eye's direction round the part, counter-clockwise from -y
    double elevation = 25;  ///< degrees, the eye's height over the horizon
    char cut = 'x';         ///< axis along which the nearer part is cut away: 'x', 'y', 'z', or '-' for none
    double cut_at = 0.5;    ///< where, as a share of the bounds along that axis
    int threads = 0;        ///< 0: one a core
    /// Surfaces and normals from a grid of the picture's full resolution, not from the fields: rough when
    /// seen closely, but at the cost of slicing a few hundred layers, in time and memory.
    bool quick = false;
    bool faults = false;  ///< the second solid is what is wrong with the part, not its supports
    /// The colour (linear light) of the part at a point, mm; empty: the same everywhere.
    std::function<dvec3(dvec3)> paint{};
};

/// Perspective view of the part and, in a colour of their own, its supports (null for none) within `bounds`
/// (finite, not empty) on a light ground. Kept of them is one bit for each cell of a grid of half the
/// picture's resolution, made from slices; surfaces and normals come from the fields themselves, unless it is
/// to be quick.
Picture render_preview(const FieldPtr& part, const FieldPtr& supports, const Box& bounds,
                       const PreviewOptions& options);

}  // namespace lamella
