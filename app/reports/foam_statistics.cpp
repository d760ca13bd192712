// Sums over the boxes of a lattice.
#include "app/reports/foam_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lamella {

FoamStatistics foam_statistics(const BuiltFoam& foam, const Box& box, int per_side) {
    const dvec3 size = box.size();
    const bool constant = foam.cell.made->constant() && foam.member.made->constant();
    const double step = std::max({size.x, size.y, size.z}) / (constant ? 1 : per_side);
    const glm::ivec3 n(glm::max(glm::ceil(size / step - 1e-9), dvec3(1)));
    FoamStatistics sums;
    double density = 0, beam = 0, solid = 0;
    for (int k = 0; k < n.z; ++k) {
        double plane = 0;
        for (int j = 0; j < n.y; ++j) {
            for (int i = 0; i < n.x; ++i) {
                const dvec3 p = box.lo + size * (dvec3(i, j, k) + 0.5) / dvec3(n);
                const double cell = foam.cell.made->at(p);
                plane += 1 / (cell * cell * cell);
                sums.greatest_cell = std::max(sums.greatest_cell, cell);
                beam += foam.member.made->at(p);
                if (foam.volume_fraction) solid += foam.volume_fraction(p);
            }
        }
        density += plane;
        sums.densest_plane = std::max(sums.densest_plane, plane / (n.x * n.y));
    }
    const double points = double(n.x) * n.y * n.z;
    sums.seeds = density / points * size.x * size.y * size.z;
    sums.mean_member = beam / points;
    sums.volume_fraction = foam.volume_fraction ? solid / points : std::numeric_limits<double>::quiet_NaN();
    return sums;
}

}  // namespace lamella
