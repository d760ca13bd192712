// Andrew's monotone chain; distances from edges.
#include "engine/base/convex_hull.h"

#include <algorithm>
#include <cmath>

namespace lamella {

std::vector<dvec2> convex_hull(std::vector<dvec2> points) {
    std::sort(points.begin(), points.end(),
              [](dvec2 a, dvec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<dvec2> hull;
    const auto add = [&hull](dvec2 p, std::size_t kept) {
        while (hull.size() > kept + 1 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0) {
            hull.pop_back();
        }
        hull.push_back(p);
    };
    for (const dvec2 p : points) add(p, 0);
    const std::size_t lower = hull.size() - 1;
    for (std::size_t k = points.size() - 1; k-- > 0;) add(points[k], lower);
    hull.pop_back();
    return hull;
}

double depth_in_hull(const std::vector<dvec2>& hull, dvec2 point) {
    double nearest = infinity;
    bool is_inside = hull.size() > 2;
    for (std::size_t k = 0; k < hull.size(); ++k) {
        const dvec2 from = hull[k], along = hull[(k + 1) % hull.size()] - from, way = point - from;
        const double square = dot(along, along);
        const double share = square > 0 ? std::clamp(dot(way, along) / square, 0.0, 1.0) : 0;
        nearest = std::min(nearest, length(way - share * along));
        is_inside = is_inside && cross(along, way) > 0;
    }
    return is_inside ? nearest : -nearest;
}

}  // namespace lamella
