// Entries of the map that are 0 are left out, so that infinite sides stay what they are.
#include "engine/base/box_image.h"

#include <algorithm>

namespace lamella {

Box image_of(const Box& box, const glm::dmat3& linear, dvec3 translation) {
    if (box.empty()) return box;
    Box image{translation, translation};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            const double m = linear[column][row];
            if (m == 0) continue;
            const double a = m * box.lo[column], b = m * box.hi[column];
            image.lo[row] += std::min(a, b);
            image.hi[row] += std::max(a, b);
        }
    }
    return image;
}

}  // namespace lamella
