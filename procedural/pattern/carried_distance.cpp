// Least squares over neighbours, and a weighted mean.
#include "procedural/pattern/carried_distance.h"

#include <cmath>

#include "engine/base/deterministic_math.h"
#include "engine/base/parallel.h"

namespace lamella {

dvec3 slope_at(const SurfaceSites& sites, std::span<const float> distances, std::size_t site) {
    const dvec3 t = sites.tangents[site], b = glm::cross(sites.normals[site], t);
    double xx = 0, xy = 0, yy = 0, xv = 0, yv = 0;
    for (const std::uint32_t other : sites.neighbours(site)) {
        const dvec3 way = sites.way(sites.places[site], sites.places[other]);
        const double x = glm::dot(way, t), y = glm::dot(way, b);
        const double rise = static_cast<double>(distances[other] - distances[site]);
        xx += x * x;
        xy += x * y;
        yy += y * y;
        xv += x * rise;
        yv += y * rise;
    }
    const double determinant = xx * yy - xy * xy;
    constexpr double least = 1e-3;  // neighbours on a line say nothing of what is aside
    if (!(determinant > least * (xx + yy) * (xx + yy))) return dvec3(0);
    const dvec3 slope = (t * (yy * xv - xy * yv) + b * (xx * yv - xy * xv)) / determinant;
    const double steepness = std::sqrt(glm::dot(slope, slope));
    return steepness > 1 ? slope / steepness : slope;
}

CarriedDistance::CarriedDistance(const SurfaceSites& sites, std::span<const float> distances)
    : sites_(sites), distances_(distances), slopes_(sites.size()) {
    parallel_for(sites.size(), [&](std::size_t i) { slopes_[i] = slope_at(sites_, distances_, i); });
}

double CarriedDistance::at(dvec3 p, std::uint32_t nearest) const {
    const auto way_from = [&](std::uint32_t site) { return sites_.way(sites_.places[site], p); };
    const auto by_plane = [&](std::uint32_t site, dvec3 way) {
        return static_cast<double>(distances_[site]) + glm::dot(slopes_[site], way);
    };
    const dvec3 own = way_from(nearest);
    const double square = glm::dot(own, own), scale = 1 / (sites_.spacing * sites_.spacing);
    double weights = 1, sum = by_plane(nearest, own);
    for (const std::uint32_t other : sites_.neighbours(nearest)) {
        const dvec3 way = way_from(other);
        const double weight = exponential(-scale * (glm::dot(way, way) - square));
        weights += weight;
        sum += weight * by_plane(other, way);
    }
    return sum / weights;
}

}  // namespace lamella
