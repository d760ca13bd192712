// How long a bead's path is.
#pragma once

#include <glm/geometric.hpp>

#include "printers/toolpath/bead.h"

namespace lamella::test {

/// In mm, with the way back to the first point of a closed one.
inline double length_of(const Bead& bead) {
    double sum = 0;
    for (std::size_t i = 1; i < bead.points.size(); ++i)
        sum += glm::distance(bead.points[i - 1], bead.points[i]);
    if (bead.closed) sum += glm::distance(bead.points.back(), bead.points.front());
    return sum;
}

}  // namespace lamella::test
