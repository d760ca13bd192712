// The pair correlation of points of varying density: how many neighbours there are at a distance, compared
// with points that know nothing of each other.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// g(s) at s = (k + 1/2) * bin, k = 0 .. bins - 1; s is the distance in local mean spacings (density^(-1/3)
/// at the first point). 1 is what a Poisson process has at all distances; a lattice has peaks.
///
/// Only points of the inner box are counted from (minus sampling), so no border needs a correction: `points`
/// must be complete within bins * bin spacings of it. A neighbour weighs 1 / density there, so that a density
/// that varies within reach has no influence (Baddeley, Moller, Waagepetersen 2000, with the local scale of
/// Hahn et al. 2003).
inline std::vector<double> pair_correlation(std::span<const dvec3> points, const Box& inner,
                                            const std::function<double(dvec3)>& density, double bin,
                                            int bins) {
    struct Point {
        dvec3 p;
        double density;
    };
    std::vector<Point> sorted;
    for (const dvec3& p : points) sorted.push_back({p, density(p)});
    std::sort(sorted.begin(), sorted.end(), [](const Point& a, const Point& b) { return a.p.x < b.p.x; });
    std::vector<double> g(static_cast<std::size_t>(bins));
    std::size_t counted = 0;
    for (const Point& a : sorted) {
        if (!inner.contains(a.p)) continue;
        ++counted;
        const double spacing = std::cbrt(1 / a.density), reach = bins * bin * spacing;
        auto b = std::lower_bound(sorted.begin(), sorted.end(), a.p.x - reach,
                                  [](const Point& point, double x) { return point.p.x < x; });
        for (; b != sorted.end() && b->p.x <= a.p.x + reach; ++b) {
            const double s = glm::length(b->p - a.p) / spacing;
            if (&*b != &a && s < bins * bin) g[static_cast<std::size_t>(s / bin)] += a.density / b->density;
        }
    }
    for (int k = 0; k < bins; ++k) {
        const double s = k * bin, t = s + bin;
        const double shell = 4.18879020478639098 * (t * t * t - s * s * s);
        g[static_cast<std::size_t>(k)] /= shell * static_cast<double>(counted);
    }
    return g;
}

}  // namespace lamella
