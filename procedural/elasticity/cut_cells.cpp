// An exponential boundary layer.
#include "procedural/elasticity/cut_cells.h"

#include <algorithm>

#include "engine/base/deterministic_math.h"

namespace lamella {

namespace {

constexpr double length_of_thin_beams = 0.36, length_lost_a_ratio = 1.2;  // in cells

}  // namespace

double cut_cells_share(Interval depths, double cell, double ratio) {
    const double length = cell * (length_of_thin_beams - length_lost_a_ratio * ratio);
    const Interval below{std::max(depths.lo, 0.0), std::max(depths.hi, 0.0)};
    if (!(length > 0)) return 1;
    const double missing = length * (exponential(-below.lo / length) - exponential(-below.hi / length));
    return below.hi > below.lo ? 1 - missing / (below.hi - below.lo) : 1 - exponential(-below.lo / length);
}

double cut_cells_depth(double cell) {
    constexpr double lengths_to_a_hundredth = 4.605;
    return lengths_to_a_hundredth * length_of_thin_beams * cell;
}

}  // namespace lamella
