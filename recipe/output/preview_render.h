// Shaded pictures of implicit solids, ray-cast from the field without a mesh.
#pragma once

#include <functional>

#include "engine/base/picture.h"
#include "engine/field/field.h"

namespace lamella {

struct PreviewOptions {
    int width = 1024;       ///< px
    int height = 1024;      ///< px
    double azimuth = 35;    ///< degrees, direction of the eye around the part, counter-clockwise from -y
    double elevation = 25;  ///< degrees, height of the eye above the horizon
    char cut = 'x';         ///< axis along which the side towards the eye is cut away: 'x', 'y', 'z', or '-'
                            ///< for none
    double cut_at = 0.5;    ///< position of the cut, as a share of the bounds along that axis
    int threads = 0;        ///< 0: one a core
    /// Takes surfaces and normals from a grid of the picture's full resolution, not from the fields: rough at
    /// close sight, but at the cost of slicing a few hundred layers, in time and memory.
    bool quick = false;
    bool faults = false;  ///< the second solid shows faults of the part, not supports
    /// Returns the colour (linear light) of the part at a point, mm; empty: uniform.
    std::function<dvec3(dvec3)> paint{};
};

/// Renders a perspective view of the part and, in another colour, its supports (null for none) within
/// `bounds` (finite, not empty) on a light ground. Memory: one bit for each cell of a grid of half the
/// picture's resolution, made from slices. Surfaces and normals come from the fields themselves, unless
/// `options` asks for a quick picture.
Picture render_preview(const FieldPtr& part, const FieldPtr& supports, const Box& bounds,
                       const PreviewOptions& options);

}  // namespace lamella
