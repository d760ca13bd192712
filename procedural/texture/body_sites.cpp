// Cubes by an octree walk, feet by Newton's method, tangents by averaging.
#include "procedural/texture/body_sites.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/skin/surface_seeds.h"
#include "procedural/skin/surface_walk.h"
#include "procedural/texture/carried_tangent.h"
#include "procedural/texture/lattice_hash.h"

namespace lamella {

namespace {

constexpr double site_precision = 1e-3;   // of the spacing
constexpr double farthest_neighbour = 2;  // spacings
constexpr int halvings_of_walk = 5;

[[noreturn]] void refuse_sites(double spacing, std::size_t most) {
    throw InputError(fmt::format(
        "the surface has more than {} sites, {:.3g} mm apart; accepted: wider struts, or a smaller part",
        most, spacing));
}

std::vector<glm::i64vec3> cubes_near(const Field& body, double spacing, std::size_t most,
                                     const CancelToken* cancel) {
    constexpr std::size_t cubes_a_site = 4;
    std::vector<glm::i64vec3> cubes;
    const double largest = spacing * (1 << halvings_of_walk);
    walk_surface(
        body, largest, 0, [&](const LatticeCube& cube) { return cube.side > 1.5 * spacing; },
        [&](const LatticeCube& cube) {
            cubes.push_back(cube.index);
            if (cubes.size() % 4096 == 0) stop_if_cancelled(cancel);
            if (cubes.size() > cubes_a_site * most) refuse_sites(spacing, most);
        });
    return cubes;
}

/// Returns whether a point lies in a cube. Borders belong to one cube only, and so do points that rounding
/// has put on either side of them.
bool holds(const glm::i64vec3& cube, double side, dvec3 p) {
    constexpr double steps = 1 << 16;
    const dvec3 at = glm::round(p / side * steps) / steps - dvec3(cube);
    return std::min({at.x, at.y, at.z}) >= 0 && std::max({at.x, at.y, at.z}) < 1;
}

void link(SurfaceSites& sites, const std::vector<glm::i64vec3>& cubes) {
    std::unordered_map<glm::i64vec3, std::uint32_t, LatticeHash> site_of;
    site_of.reserve(cubes.size());
    for (std::uint32_t i = 0; i < cubes.size(); ++i) site_of.emplace(cubes[i], i);
    std::vector<std::vector<std::uint32_t>> links(cubes.size());
    parallel_for(cubes.size(), [&](std::size_t i) {
        for (int k = 0; k < 27; ++k) {
            const glm::i64vec3 step(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            const std::int64_t axes = step.x * step.x + step.y * step.y + step.z * step.z;
            if (axes == 0 || axes == 3) continue;
            const auto found = site_of.find(cubes[i] + step);
            if (found == site_of.end() || back_to_back(sites.normals[i], sites.normals[found->second]))
                continue;
            const dvec3 way = sites.places[found->second] - sites.places[i];
            if (glm::dot(way, way) <= std::pow(farthest_neighbour * sites.spacing, 2))
                links[i].push_back(found->second);
        }
    });
    sites.first.push_back(0);
    for (const auto& of_site : links) {
        sites.adjacent.insert(sites.adjacent.end(), of_site.begin(), of_site.end());
        sites.first.push_back(static_cast<std::uint32_t>(sites.adjacent.size()));
    }
}

/// Returns a direction in the plane at right angles to a normal: that of the first vector which has one.
dvec3 tangent_of(dvec3 normal, dvec3 first, dvec3 second) {
    for (const dvec3 way : {first, second, dvec3(normal.y, normal.z, normal.x)}) {
        const dvec3 flat = way - normal * glm::dot(normal, way);
        const double length = std::sqrt(glm::dot(flat, flat));
        constexpr double least = 1e-3;
        if (length > least) return flat / length;
    }
    return {1, 0, 0};
}

}  // namespace

SurfaceSites sites_on_surface(const Field& body, double spacing, std::size_t most,
                              const CancelToken* cancel) {
    const std::vector<glm::i64vec3> cubes = cubes_near(body, spacing, most, cancel);
    std::vector<std::optional<SurfaceFoot>> feet(cubes.size());
    parallel_for(cubes.size(), [&](std::size_t i) {
        if (i % 1024 == 0) stop_if_cancelled(cancel);
        const auto foot = foot_on_surface(body, (dvec3(cubes[i]) + 0.5) * spacing, site_precision * spacing);
        if (foot && holds(cubes[i], spacing, foot->place)) feet[i] = foot;
    });
    SurfaceSites sites;
    sites.spacing = spacing;
    std::vector<glm::i64vec3> occupied;
    for (std::size_t i = 0; i < cubes.size(); ++i) {
        if (!feet[i]) continue;
        occupied.push_back(cubes[i]);
        sites.places.push_back(feet[i]->place);
        sites.normals.push_back(feet[i]->normal);
    }
    if (sites.size() > most) refuse_sites(spacing, most);
    if (sites.size() == 0)
        throw InputError(
            "no point of the body's surface was found; accepted: a body whose values are distances");
    link(sites, occupied);
    return sites;
}

void set_tangents(SurfaceSites& sites, const SurfaceSites* coarser, std::optional<dvec3> axis, int sweeps) {
    const std::size_t count = sites.size();
    sites.tangents.resize(count);
    if (axis) {
        for (std::size_t i = 0; i < count; ++i) {
            const dvec3 n = sites.normals[i], up = tangent_of(n, *axis, {axis->y, axis->z, axis->x});
            sites.tangents[i] = glm::cross(up, n);
        }
        return;
    }
    if (coarser != nullptr) {
        const std::vector<std::uint32_t> nearest = nearest_sites(*coarser, sites.places, sites.normals);
        for (std::size_t i = 0; i < count; ++i) {
            const dvec3 there = carried_tangent(coarser->tangents[nearest[i]], coarser->normals[nearest[i]],
                                                sites.normals[i]);
            sites.tangents[i] = tangent_of(sites.normals[i], there, {1, 0, 0});
        }
    } else {
        for (std::size_t i = 0; i < count; ++i)
            sites.tangents[i] = tangent_of(sites.normals[i], {1, 0, 0}, {0, 1, 0});
    }
    // Vectors keep their lengths between sweeps: where directions contradict each other they become short,
    // and the others decide (the smoothest field of Knoeppel, Crane, Pinkall, Schroeder 2013, by power
    // iteration).
    std::vector<dvec3> now = sites.tangents, next(count);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        parallel_for(count, [&](std::size_t i) {
            dvec3 sum = now[i];
            for (const std::uint32_t other : sites.neighbours(i))
                sum += carried_tangent(now[other], sites.normals[other], sites.normals[i]);
            next[i] = sum / static_cast<double>(1 + sites.neighbours(i).size());
        });
        now.swap(next);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const double length = std::sqrt(glm::dot(now[i], now[i]));
        sites.tangents[i] =
            tangent_of(sites.normals[i], length > 0 ? now[i] / length : now[i], sites.tangents[i]);
    }
}

}  // namespace lamella
