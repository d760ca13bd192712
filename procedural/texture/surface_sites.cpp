// Flat sheets, and the search for near sites by a hash of cubes.
#include "procedural/texture/surface_sites.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/skin/surface_seeds.h"
#include "procedural/texture/lattice_hash.h"

namespace lamella {

namespace {

/// The sites of each cube of two spacings.
class SiteCubes {
  public:
    explicit SiteCubes(const SurfaceSites& sites) : sites_(sites), side_(2 * sites.spacing) {
        for (int axis = 0; axis < 3; ++axis) {
            if (sites.period[axis] > 0)
                count_[axis] = std::max(std::int64_t{1},
                                        static_cast<std::int64_t>(std::floor(sites.period[axis] / side_)));
        }
        for (std::size_t i = 0; i < sites.size(); ++i)
            cubes_[cube_of(sites.places[i])].push_back(static_cast<std::uint32_t>(i));
    }

    std::uint32_t nearest(dvec3 place, dvec3 normal) const {
        std::uint32_t best = 0;
        double least = infinity;
        const auto consider = [&](std::uint32_t site) {
            const dvec3 way = sites_.way(place, sites_.places[site]);
            const double square = glm::dot(way, way);
            if (square < least || (square == least && site < best)) {
                least = square;
                best = site;
            }
        };
        const glm::i64vec3 middle = cube_of(place);
        for (std::int64_t z = -1; z <= 1; ++z) {
            for (std::int64_t y = -1; y <= 1; ++y) {
                for (std::int64_t x = -1; x <= 1; ++x) {
                    const auto found = cubes_.find(wrapped(middle + glm::i64vec3(x, y, z)));
                    if (found == cubes_.end()) continue;
                    for (const std::uint32_t site : found->second) {
                        if (!back_to_back(normal, sites_.normals[site])) consider(site);
                    }
                }
            }
        }
        if (least == infinity) {
            for (std::size_t i = 0; i < sites_.size(); ++i) consider(static_cast<std::uint32_t>(i));
        }
        return best;
    }

  private:
    /// Cubes of a period are a little larger, so that a whole number of them fits.
    double side(int axis) const {
        return count_[axis] > 0 ? sites_.period[axis] / static_cast<double>(count_[axis]) : side_;
    }
    glm::i64vec3 cube_of(dvec3 p) const {
        glm::i64vec3 at;
        for (int axis = 0; axis < 3; ++axis)
            at[axis] = static_cast<std::int64_t>(std::floor(p[axis] / side(axis)));
        return wrapped(at);
    }
    glm::i64vec3 wrapped(glm::i64vec3 at) const {
        for (int axis = 0; axis < 3; ++axis) {
            if (count_[axis] > 0) at[axis] = (at[axis] % count_[axis] + count_[axis]) % count_[axis];
        }
        return at;
    }

    const SurfaceSites& sites_;
    double side_;
    glm::i64vec3 count_{0};  // along axes along which the sites repeat
    std::unordered_map<glm::i64vec3, std::vector<std::uint32_t>, LatticeHash> cubes_;
};

}  // namespace

SurfaceSites flat_sites(int width, int height, double spacing) {
    constexpr int least = 3;  // a site's neighbours to the left and to the right are two
    if (width < least || height < least)
        throw InputError("a sheet of " + std::to_string(width) + " x " + std::to_string(height) +
                         " sites; expected at least 3 along each side");
    SurfaceSites sites;
    sites.spacing = spacing;
    sites.period = {width * spacing, height * spacing, 0};
    sites.first.push_back(0);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            sites.places.emplace_back((x + 0.5) * spacing, (y + 0.5) * spacing, 0);
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    if (dx == 0 && dy == 0) continue;
                    const int across = (x + dx + width) % width, along = (y + dy + height) % height;
                    sites.adjacent.push_back(static_cast<std::uint32_t>(along * width + across));
                }
            }
            sites.first.push_back(static_cast<std::uint32_t>(sites.adjacent.size()));
        }
    }
    sites.normals.assign(sites.size(), dvec3(0, 0, 1));
    sites.tangents.assign(sites.size(), dvec3(1, 0, 0));
    return sites;
}

std::vector<std::uint32_t> nearest_sites(const SurfaceSites& sites, std::span<const dvec3> places,
                                         std::span<const dvec3> normals) {
    const SiteCubes cubes(sites);
    std::vector<std::uint32_t> nearest(places.size());
    parallel_for(places.size(), [&](std::size_t i) { nearest[i] = cubes.nearest(places[i], normals[i]); });
    return nearest;
}

}  // namespace lamella
