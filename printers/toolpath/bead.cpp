// Cross-sections of beads: rectangles with semicircular sides.
#include "printers/toolpath/bead.h"

#include <cmath>

namespace lamella {
namespace {}  // namespace

double side_loss(double height) { return height * (1 - pi / 4); }

double bead_area(double width, double height) {
    return width > height ? height * (width - side_loss(height)) : pi / 4 * width * height;
}

double bead_width(double area, double height) {
    return area > pi / 4 * height * height ? area / height + side_loss(height) : area / (pi / 4 * height);
}

double bead_volume(const Bead& bead, double height) {
    double volume = 0;
    const std::size_t n = bead.points.size();
    for (std::size_t i = 0; i + (bead.closed ? 0 : 1) < n; ++i) {
        const std::size_t j = (i + 1) % n;
        volume += glm::distance(bead.points[i], bead.points[j]) *
                  (bead_area(bead.width_at(i), height) + bead_area(bead.width_at(j), height)) / 2;
    }
    return volume * bead.flow;
}

}  // namespace lamella
