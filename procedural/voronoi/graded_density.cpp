// Integrates the density that follows from a cell size, by octants where the size varies.
#include "procedural/voronoi/graded_density.h"

namespace lamella {
namespace {

constexpr double steady = 1.05;

double per_cube(double side) { return 1 / (side * side * side); }

double volume(const Box& box) {
    const dvec3 size = box.size();
    return size.x * size.y * size.z;
}

Box octant_of(const Box& box, int octant) {
    const dvec3 center = box.center();
    Box part = box;
    for (int axis = 0; axis < 3; ++axis) ((octant >> axis) & 1 ? part.lo : part.hi)[axis] = center[axis];
    return part;
}

}  // namespace

Interval GradedDensity::range(const Box& box) const {
    const Interval cell = cell_->range(box);
    return {per_cube(cell.hi), per_cube(cell.lo)};
}

double GradedDensity::integral(const Box& box) const {
    double whole = 0;
    integrals({&box, 1}, {&whole, 1});
    return whole;
}

/// A leaf of the seed tree holds at most eight seeds, so eight samples are enough.
void GradedDensity::integrals(std::span<const Box> boxes, std::span<double> out) const {
    std::vector<Box> parts;
    std::vector<std::size_t> ends;  // end of each box's parts
    for (const Box& box : boxes) {
        const Interval cell = cell_->range(box);
        if (cell.hi <= steady * cell.lo) {
            parts.push_back(box);
        } else {
            for (int octant = 0; octant < 8; ++octant) parts.push_back(octant_of(box, octant));
        }
        ends.push_back(parts.size());
    }
    std::vector<dvec3> centers;
    centers.reserve(parts.size());
    for (const Box& part : parts) centers.push_back(part.center());
    std::vector<double> cells(parts.size());
    cell_->numbers(centers, cells);
    std::size_t next = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        out[i] = 0;
        for (; next < ends[i]; ++next) out[i] += volume(parts[next]) * per_cube(cells[next]);
    }
}

}  // namespace lamella
