// PreviewOptions: what a picture shows and from where.
#pragma once

#include <functional>
#include <optional>

#include "engine/base/geometry.h"

namespace lamella {

struct PreviewOptions {
    int width = 1024;       ///< px
    int height = 1024;      ///< px
    double azimuth = 35;    ///< degrees, direction of the eye around the part, counter-clockwise from -y
    double elevation = 25;  ///< degrees, height of the eye above the horizon
    char cut = 'x';         ///< axis along which the side towards the eye is cut away: 'x', 'y', 'z', or '-'
                            ///< for none
    double cut_at = 0.5;    ///< position of the cut, as a share of the bounds along that axis
    /// Height of what is printed so far, mm in part coordinates: only what lies below is shown, at the scale
    /// of the whole part, and `cut` does not count.
    std::optional<double> printed_to{};
    /// Shows the bounds at the same scale from every direction and whatever is cut away, for frames of an
    /// orbit; otherwise what is seen just fits the picture.
    bool steady = false;
    bool smooth = true;   ///< takes more samples along edges; without them, frames follow faster
    int threads = 0;      ///< 0: one a core
    bool faults = false;  ///< the second solid shows faults of the part, not supports
    /// Returns the colour (linear light) of the part at a point, mm; empty: uniform.
    std::function<dvec3(dvec3)> paint{};
};

}  // namespace lamella
