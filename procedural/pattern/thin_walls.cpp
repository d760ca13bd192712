// The other side by steps along the inward normal, its pattern by the plane at the site there; sides are the
// connected components of thin sites.
#include "procedural/pattern/thin_walls.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "engine/base/parallel.h"
#include "procedural/pattern/carried_distance.h"
#include "procedural/pattern/pattern_pieces.h"
#include "procedural/skin/surface_seeds.h"
#include "procedural/skin/surface_walk.h"

namespace lamella {

namespace {

/// Returns the point where the line from a site into the body leaves it, at most `thickness` mm away.
std::optional<dvec3> exit_below(const Field& body, dvec3 place, dvec3 normal, double thickness,
                                double spacing) {
    // Half-way down a thin wall, the other side is the nearer one.
    constexpr double nearly = 0.98;
    if (body.value(place - 0.5 * thickness * normal) <= -0.5 * nearly * thickness) return std::nullopt;
    const double least_step = 0.1 * spacing;
    double depth = 0.5 * spacing;
    while (depth <= thickness) {
        const dvec3 p = place - depth * normal;
        const double value = body.value(p);
        if (value >= 0) return p;
        depth += std::max(-value, least_step);
    }
    return std::nullopt;
}

/// Returns the value across from a site, which has to be on a thin wall.
float value_across(const SurfaceSites& sites, std::span<const float> values, std::size_t site) {
    const std::uint32_t other = sites.across[site];
    const dvec3 way = sites.way(sites.places[other], sites.places[site]);
    return static_cast<float>(static_cast<double>(values[other]) +
                              glm::dot(slope_at(sites, values, other), way));
}

}  // namespace

void set_across(SurfaceSites& sites, const Field& body, double thickness) {
    std::vector<std::optional<SurfaceFoot>> exits(sites.size());
    parallel_for(sites.size(), [&](std::size_t i) {
        const auto exit = exit_below(body, sites.places[i], sites.normals[i], thickness, sites.spacing);
        if (!exit) return;
        const auto foot = foot_on_surface(body, *exit, 0.01 * sites.spacing);
        if (foot && back_to_back(foot->normal, sites.normals[i])) exits[i] = foot;
    });
    std::vector<std::size_t> thin;
    std::vector<dvec3> places, normals;
    for (std::size_t i = 0; i < exits.size(); ++i) {
        if (!exits[i]) continue;
        thin.push_back(i);
        places.push_back(exits[i]->place);
        normals.push_back(exits[i]->normal);
    }
    sites.across.clear();
    if (thin.empty()) return;
    sites.across.assign(sites.size(), SurfaceSites::none);
    const std::vector<std::uint32_t> nearest = nearest_sites(sites, places, normals);
    constexpr double farthest = 2;  // spacings: beyond, no site stands for the place
    for (std::size_t k = 0; k < thin.size(); ++k) {
        if (length(sites.way(places[k], sites.places[nearest[k]])) <= farthest * sites.spacing)
            sites.across[thin[k]] = nearest[k];
    }
}

std::vector<std::uint32_t> back_sites(const SurfaceSites& sites) {
    if (sites.across.empty()) return {};
    std::vector<float> is_thin;
    for (const std::uint32_t other : sites.across) is_thin.push_back(other != SurfaceSites::none ? 1 : -1);
    const SitePieces sides = pieces_of(sites, is_thin);
    std::vector<std::vector<std::uint32_t>> members(sides.sizes.size());
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
        if (sides.piece[i] != SitePieces::none) members[sides.piece[i]].push_back(i);
    }
    std::vector<std::size_t> order(members.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater<>{}, [&](std::size_t side) { return members[side].size(); });
    enum class Role : std::uint8_t { undecided, front, back };
    std::vector<Role> roles(members.size(), Role::undecided);
    for (const std::size_t side : order) {
        if (roles[side] != Role::undecided) continue;
        roles[side] = Role::front;
        for (const std::uint32_t site : members[side]) {
            const std::uint32_t other = sides.piece[sites.across[site]];
            if (other != SitePieces::none && roles[other] == Role::undecided) roles[other] = Role::back;
        }
    }
    std::vector<std::uint32_t> back;
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
        if (sides.piece[i] == SitePieces::none || roles[sides.piece[i]] != Role::back) continue;
        const std::uint32_t other = sides.piece[sites.across[i]];
        if (other != SitePieces::none && roles[other] == Role::front) back.push_back(i);
    }
    return back;
}

void copy_across(const SurfaceSites& sites, std::span<const std::uint32_t> back, std::vector<float>& values) {
    std::vector<float> copies(back.size());
    parallel_for(back.size(), [&](std::size_t k) { copies[k] = value_across(sites, values, back[k]); });
    for (std::size_t k = 0; k < back.size(); ++k) values[back[k]] = copies[k];
}

void share_across(const SurfaceSites& sites, std::vector<float>& values) {
    if (sites.across.empty()) return;
    std::vector<float> shared = values;
    parallel_for(sites.size(), [&](std::size_t i) {
        if (sites.across[i] != SurfaceSites::none)
            shared[i] = std::max(values[i], value_across(sites, values, i));
    });
    values = std::move(shared);
}

}  // namespace lamella
