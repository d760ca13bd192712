// Points of cubes against the skin, and their nearest sites on a lattice.
#include "procedural/pattern/skin_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/pattern/nearest_on_lattice.h"

namespace lamella {

namespace {

constexpr double most_cubes = 3e7;

/// Returns the site nearest to a point among one near it and its neighbours.
std::uint32_t nearest_of(const SurfaceSites& sites, std::uint32_t near, dvec3 p) {
    std::uint32_t best = near;
    double least = infinity;
    const auto consider = [&](std::uint32_t site) {
        const dvec3 way = sites.places[site] - p;
        if (glm::dot(way, way) >= least) return;
        least = glm::dot(way, way);
        best = site;
    };
    consider(near);
    for (const std::uint32_t other : sites.neighbours(near)) consider(other);
    return best;
}

/// Returns the box of the skin in whole cubes.
Box box_of_cubes(const Field& shell, double edge, glm::ivec3& size) {
    const Box bounds = shell.bounds();
    const dvec3 along = glm::ceil(bounds.size() / edge);
    if (!(along.x * along.y * along.z <= most_cubes))
        throw InputError(fmt::format(
            "forces need {:.3g} x {:.3g} x {:.3g} elements of {:.3g} mm, and at most {:.3g} in all are "
            "computed; accepted: reinforce = \"shape\", or wider struts",
            along.x, along.y, along.z, edge, most_cubes));
    size = glm::max(glm::ivec3(along), glm::ivec3(1));
    const dvec3 middle = 0.5 * (bounds.lo + bounds.hi), half = 0.5 * edge * dvec3(size);
    return {middle - half, middle + half};
}

}  // namespace

SkinElements::SkinElements(const Field& shell, const SurfaceSites& sites, double depth, double edge,
                           const CancelToken* cancel)
    : sites_(sites), box_(box_of_cubes(shell, edge, size_)), edge_(edge) {
    const double margin = 2 * sites.spacing;
    const NearestOnLattice nearest(sites, depth + margin, margin);
    struct Cube {
        std::uint32_t number;
        std::vector<std::uint32_t> nearest;
    };
    const int rows = size_.y * size_.z;
    std::vector<std::vector<Cube>> found(static_cast<std::size_t>(rows));
    parallel_for(rows, [&](int row) {
        stop_if_cancelled(cancel);
        for (int x = 0; x < size_.x; ++x) {
            const glm::ivec3 at(x, row % size_.y, row / size_.y);
            const dvec3 low = box_.lo + edge_ * dvec3(at);
            if (shell.value(low + 0.5 * edge_) > edge_) continue;
            Cube cube{static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(size_.x) +
                          static_cast<std::uint32_t>(x),
                      {}};
            for (int k = 0; k < points_along * points_along * points_along; ++k) {
                const dvec3 p = low + edge_ / points_along * (dvec3(k & 1, k >> 1 & 1, k >> 2) + 0.5);
                if (shell.value(p) > 0) continue;
                const std::uint32_t site = nearest.site(glm::i64vec3(glm::round(p / sites.spacing)));
                if (site != NearestOnLattice::none) cube.nearest.push_back(nearest_of(sites, site, p));
            }
            if (!cube.nearest.empty()) found[static_cast<std::size_t>(row)].push_back(std::move(cube));
        }
    });
    first_.push_back(0);
    for (const auto& of_row : found) {
        for (const Cube& cube : of_row) {
            cubes_.push_back(cube.number);
            nearest_.insert(nearest_.end(), cube.nearest.begin(), cube.nearest.end());
            first_.push_back(static_cast<std::uint32_t>(nearest_.size()));
        }
    }
}

std::vector<float> SkinElements::shares(std::span<const float> distances) const {
    std::vector<float> shares(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                              static_cast<std::size_t>(size_.z));
    const double border = edge_ / points_along;  // a point stands for as much to either side
    for (std::size_t i = 0; i < cubes_.size(); ++i) {
        double sum = 0;
        for (std::uint32_t k = first_[i]; k < first_[i + 1]; ++k)
            sum += distances.empty()
                       ? 1
                       : std::clamp(0.5 + static_cast<double>(distances[nearest_[k]]) / border, 0.0, 1.0);
        shares[cubes_[i]] = static_cast<float>(sum / points_in_a_cube);
    }
    return shares;
}

std::vector<std::uint32_t> SkinElements::cubes_of_sites(std::span<const float> shares, double least) const {
    std::vector<std::uint32_t> cubes(sites_.size(), none);
    const auto take_better = [&](std::uint32_t& cube, std::uint32_t other) {
        if (cube == none || shares[other] > shares[cube]) cube = other;
    };
    for (std::size_t i = 0; i < cubes_.size(); ++i) {
        if (static_cast<double>(shares[cubes_[i]]) < least) continue;
        for (std::uint32_t k = first_[i]; k < first_[i + 1]; ++k) take_better(cubes[nearest_[k]], cubes_[i]);
    }
    std::vector<std::uint32_t> all = cubes;
    for (std::size_t i = 0; i < cubes.size(); ++i) {
        if (cubes[i] != none) continue;
        for (const std::uint32_t other : sites_.neighbours(i)) {
            if (cubes[other] != none) take_better(all[i], cubes[other]);
        }
    }
    return all;
}

}  // namespace lamella
