// Density from cell size, integrated by halving where the size changes.
#include "procedural/graded_density.h"

namespace lamella {
namespace {

constexpr int most_halvings = 1;  // a leaf holds eight seeds at most: a reading for each will do
constexpr double steady = 1.05;

double per_cube(double side) { return 1 / (side * side * side); }

}  // namespace

Interval GradedDensity::range(const Box& box) const {
    const Interval cell = cell_->range(box);
    return {per_cube(cell.hi), per_cube(cell.lo)};
}

double GradedDensity::integral(const Box& box) const { return integral(box, most_halvings); }

double GradedDensity::integral(const Box& box, int halvings) const {
    const dvec3 size = box.size(), center = box.center();
    const auto is_steady = [&] {
        const Interval cell = cell_->range(box);
        return cell.hi <= steady * cell.lo;
    };
    if (halvings == 0 || is_steady()) {
        return size.x * size.y * size.z * per_cube(cell_->at(center));
    }
    double sum = 0;
    for (int octant = 0; octant < 8; ++octant) {
        Box part = box;
        for (int axis = 0; axis < 3; ++axis) ((octant >> axis) & 1 ? part.lo : part.hi)[axis] = center[axis];
        sum += integral(part, halvings - 1);
    }
    return sum;
}

}  // namespace lamella
