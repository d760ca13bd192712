// Edges lie between neighbours of different normals; their sites are handed on from site to site.
#include "procedural/pattern/sharp_edges.h"

#include <algorithm>

#include "engine/base/parallel.h"
#include "procedural/pattern/carried_distance.h"
#include "procedural/skin/surface_seeds.h"

namespace lamella {

namespace {

/// Whether two normals are those of faces that meet in a sharp edge.
bool of_two_faces(dvec3 normal, dvec3 other) {
    constexpr double cosine = 0.8;  // 37 degrees
    return glm::dot(normal, other) < cosine && !back_to_back(normal, other);
}

bool is_over_edge(const SurfaceSites& sites, std::uint32_t site, std::uint32_t other) {
    const dvec3 way = sites.way(sites.places[site], sites.places[other]);
    return of_two_faces(sites.normals[site], sites.normals[other]) &&
           glm::dot(way, sites.normals[site]) < 0 && glm::dot(way, sites.normals[other]) > 0;
}

}  // namespace

void set_over_edges(SurfaceSites& sites, double width) {
    sites.over_edge.assign(sites.size(), SurfaceSites::none);
    std::vector<std::uint32_t> open;
    const auto square = [&](std::uint32_t site, std::uint32_t other) {
        const dvec3 way = sites.way(sites.places[site], sites.places[other]);
        return glm::dot(way, way);
    };
    const auto offer = [&](std::uint32_t site, std::uint32_t other) {
        const std::uint32_t now = sites.over_edge[site];
        const double here = square(site, other);
        if (here > width * width || !of_two_faces(sites.normals[site], sites.normals[other])) return;
        if (now != SurfaceSites::none &&
            (here > square(site, now) || (here == square(site, now) && other >= now)))
            return;
        sites.over_edge[site] = other;
        open.push_back(site);
    };
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
        for (const std::uint32_t other : sites.neighbours(i)) {
            if (is_over_edge(sites, i, other)) offer(i, other);
        }
    }
    if (open.empty()) return sites.over_edge.clear();
    for (std::size_t next = 0; next < open.size(); ++next) {
        const std::uint32_t site = open[next], other = sites.over_edge[site];
        for (const std::uint32_t beside : sites.neighbours(site)) offer(beside, other);
    }
}

void share_over_edges(const SurfaceSites& sites, std::vector<float>& values) {
    if (sites.over_edge.empty()) return;
    std::vector<float> shared = values;
    parallel_for(sites.size(), [&](std::size_t i) {
        const std::uint32_t other = sites.over_edge[i];
        if (other == SurfaceSites::none) return;
        const dvec3 along = glm::cross(sites.normals[i], sites.normals[other]);
        const dvec3 way = sites.way(sites.places[other], sites.places[i]);
        const double shift = glm::dot(way, along) / glm::dot(along, along);
        const double there =
            static_cast<double>(values[other]) + shift * glm::dot(slope_at(sites, values, other), along);
        shared[i] = std::max(values[i], static_cast<float>(there));
    });
    values = std::move(shared);
}

}  // namespace lamella
