// Line and pixel ranges of the lattice.
#include "engine/runs/plane_lattice.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/number_format.h"

namespace lamella {

RowBand plane_lattice(Axis axis, const Rect& rect, double pitch) {
    constexpr double fraction = 0.118;
    constexpr double most = 1 << 20;
    const int along = axis == Axis::x ? 0 : 1, across = 1 - along;
    RowBand band{
        .axis = axis, .along_pitch = pitch, .across_origin = fraction * pitch, .across_pitch = pitch};
    const dvec2 from = glm::floor(rect.lo / pitch) - 1.0, to = glm::ceil(rect.hi / pitch) + 1.0;
    if (!(-most < std::min(from.x, from.y) && std::max(to.x, to.y) < most)) {
        throw InputError("a pitch of " + format_number(pitch, 6) +
                         " mm is too fine for outlines this far from the origin, or the layer is unbounded");
    }
    band.first = static_cast<int>(from[across]);
    band.count = static_cast<int>(to[across]) - band.first;
    band.lo = static_cast<int>(from[along]);
    band.hi = static_cast<int>(to[along]);
    return band;
}

}  // namespace lamella
