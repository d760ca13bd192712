// Label-correcting propagation over the six neighbours of each point.
#include "procedural/pattern/nearest_on_lattice.h"

#include <cmath>

#include "engine/base/parallel.h"

namespace lamella {

namespace {

glm::i64vec3 brick_of(glm::i64vec3 at) { return {at.x >> 3, at.y >> 3, at.z >> 3}; }

std::size_t place_of(glm::i64vec3 at) {
    return static_cast<std::size_t>((at.x & 7) + 8 * ((at.y & 7) + 8 * (at.z & 7)));
}

}  // namespace

NearestOnLattice::NearestOnLattice(const SurfaceSites& sites, double depth, double height)
    : sites_(sites), square_(depth * depth), height_(height) {
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
        const glm::i64vec3 cube(glm::floor(sites.places[i] / sites.spacing));
        for (int k = 0; k < 8; ++k) propose(cube + glm::i64vec3(k & 1, k >> 1 & 1, k >> 2), i);
    }
    while (!open_.empty()) {
        const glm::i64vec3 at = open_.front();
        open_.pop_front();
        const std::uint32_t site = stored(at);
        for (int axis = 0; axis < 3; ++axis) {
            for (const int step : {-1, 1}) {
                glm::i64vec3 next = at;
                next[axis] += step;
                propose(next, site);
            }
        }
    }
    parallel_for(bricks_.size(), [&](std::size_t b) { descend(bricks_[b]); });
}

/// Goes on from each point's site to its neighbours, as long as one is nearer.
void NearestOnLattice::descend(Brick& brick) const {
    for (std::size_t k = 0; k < brick.sites.size(); ++k) {
        std::uint32_t& now = brick.sites[k];
        if (now == none) continue;
        const auto place = static_cast<std::int64_t>(k);
        const glm::i64vec3 at = std::int64_t{side} * brick.corner +
                                glm::i64vec3(place % side, place / side % side, place / side / side);
        double least = square(at, now);
        for (bool moved = true; moved;) {
            moved = false;
            for (const std::uint32_t other : sites_.neighbours(now)) {
                const double there = square(at, other);
                if (!(there < least)) continue;
                least = there;
                now = other;
                moved = true;
                break;
            }
        }
    }
}

std::uint32_t NearestOnLattice::site(glm::i64vec3 at) const {
    std::size_t hint = 0;
    return site(at, hint);
}

std::uint32_t NearestOnLattice::site(glm::i64vec3 at, std::size_t& hint) const {
    const glm::i64vec3 corner = brick_of(at);
    if (hint >= bricks_.size() || bricks_[hint].corner != corner) {
        const auto found = numbers_.find(corner);
        if (found == numbers_.end()) return none;
        hint = found->second;
    }
    return bricks_[hint].sites[place_of(at)];
}

std::vector<glm::i64vec3> NearestOnLattice::bricks() const {
    std::vector<glm::i64vec3> corners;
    corners.reserve(bricks_.size());
    for (const Brick& brick : bricks_) corners.push_back(brick.corner);
    return corners;
}

std::uint32_t& NearestOnLattice::stored(glm::i64vec3 at) {
    const glm::i64vec3 corner = brick_of(at);
    if (last_ >= bricks_.size() || bricks_[last_].corner != corner) {
        const auto [found, is_new] = numbers_.emplace(corner, bricks_.size());
        if (is_new) bricks_.push_back({corner, std::vector<std::uint32_t>(brick_points, none)});
        last_ = found->second;
    }
    return bricks_[last_].sites[place_of(at)];
}

double NearestOnLattice::square(glm::i64vec3 at, std::uint32_t site) const {
    const dvec3 way = dvec3(at) * sites_.spacing - sites_.places[site];
    return glm::dot(way, way);
}

/// Takes the site if it is nearer than that of the point; of equally near ones, the lower number.
void NearestOnLattice::propose(glm::i64vec3 at, std::uint32_t site) {
    const dvec3 way = dvec3(at) * sites_.spacing - sites_.places[site];
    const double here = glm::dot(way, way);
    if (here > square_ || glm::dot(way, sites_.normals[site]) > height_) return;
    std::uint32_t& now = stored(at);
    if (now != none) {
        const double before = square(at, now);
        if (here > before || (here == before && site >= now)) return;
    }
    now = site;
    open_.push_back(at);
}

}  // namespace lamella
