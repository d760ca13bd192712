// Nearest solid sites are handed on into the gaps; where different ones meet from opposite sides is a
// crossing.
#include "procedural/pattern/gap_crossings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "engine/base/parallel.h"
#include "procedural/pattern/pattern_pieces.h"

namespace lamella {

namespace {

constexpr std::uint32_t no_site = SitePieces::none;

}  // namespace

GapCrossings::GapCrossings(const SurfaceSites& sites, std::span<const float> values)
    : sites_(sites), owner_(sites.size(), no_site), before_(sites.size(), no_site) {
    hand_on_owners(values);
    find_crossings();
}

void GapCrossings::hand_on_owners(std::span<const float> values) {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    std::vector<double> square(sites_.size(), infinity);
    const auto propose = [&](std::uint32_t site, std::uint32_t owner, std::uint32_t before) {
        const dvec3 way = sites_.way(sites_.places[site], sites_.places[owner]);
        const double distance = glm::dot(way, way);
        if (!(distance < square[site])) return;
        square[site] = distance;
        owner_[site] = owner;
        before_[site] = before;
        open.emplace(distance, site);
    };
    for (std::uint32_t i = 0; i < sites_.size(); ++i) {
        if (values[i] > 0) continue;
        for (const std::uint32_t other : sites_.neighbours(i)) {
            if (values[other] > 0) propose(i, other, other);
        }
    }
    while (!open.empty()) {
        const auto [distance, site] = open.top();
        open.pop();
        if (distance > square[site]) continue;
        for (const std::uint32_t other : sites_.neighbours(site)) {
            if (!(values[other] > 0)) propose(other, owner_[site], site);
        }
    }
}

void GapCrossings::find_crossings() {
    constexpr double opposite = -0.5;    // cosine of the angle between the ways to both ends
    constexpr double as_straight = 0.9;  // as the way through the medial axis
    std::vector<std::vector<GapCrossing>> found(sites_.size());
    parallel_for(sites_.size(), [&](std::size_t i) {
        const auto from = static_cast<std::uint32_t>(i);
        if (owner_[i] == no_site) return;
        const dvec3 back = sites_.way(sites_.places[i], sites_.places[owner_[i]]);
        for (const std::uint32_t to : sites_.neighbours(i)) {
            if (to < from || owner_[to] == no_site || owner_[to] == owner_[i]) continue;
            const dvec3 ahead = sites_.way(sites_.places[to], sites_.places[owner_[to]]);
            const double ways = length(back) + length(ahead);
            if (glm::dot(back, ahead) > opposite * length(back) * length(ahead)) continue;
            const double width = length(sites_.way(sites_.places[owner_[i]], sites_.places[owner_[to]]));
            if (width < as_straight * ways) continue;
            found[i].push_back({owner_[i], owner_[to], from, to, width});
        }
    });
    for (const auto& of_site : found) crossings_.insert(crossings_.end(), of_site.begin(), of_site.end());
}

SiteLine GapCrossings::line(const GapCrossing& crossing) const {
    std::vector<std::uint32_t> line;
    const auto trace = [&](std::uint32_t site) {
        for (; site != no_site; site = before_[site]) line.push_back(site);
    };
    trace(crossing.middle_from);
    std::ranges::reverse(line);
    trace(crossing.middle_to);
    return straightened(sites_, line);
}

SiteLine straightened(const SurfaceSites& sites, std::span<const std::uint32_t> line) {
    SiteLine points;
    if (line.empty()) return points;
    const dvec3 begin = sites.places[line.front()], chord = sites.way(begin, sites.places[line.back()]);
    const double straight = length(chord);
    for (const std::uint32_t site : line) {
        SitePoint point{site, sites.places[site]};
        const dvec3 sideways = glm::cross(sites.normals[site], chord);
        const double width = length(sideways);
        constexpr double least = 1e-6;
        if (width > least * straight) {
            const dvec3 way = sites.way(begin, point.place);
            point.place -= glm::dot(way, sideways) / (width * width) * sideways;
        }
        points.push_back(point);
    }
    return points;
}

SitesApart::SitesApart(const SurfaceSites& sites, double distance)
    : sites_(sites), square_(distance * distance), blocked_(sites.size(), 0) {}

void SitesApart::take(std::uint32_t site) {
    constexpr std::uint8_t is_reached = 2;  // by this flood, which passes through what is blocked already
    open_.assign(1, site);
    std::vector<std::uint32_t> reached{site};
    blocked_[site] |= is_reached;
    while (!open_.empty()) {
        const std::uint32_t at = open_.back();
        open_.pop_back();
        for (const std::uint32_t other : sites_.neighbours(at)) {
            if ((blocked_[other] & is_reached) != 0) continue;
            const dvec3 way = sites_.way(sites_.places[site], sites_.places[other]);
            if (glm::dot(way, way) > square_) continue;
            blocked_[other] |= is_reached;
            reached.push_back(other);
            open_.push_back(other);
        }
    }
    for (const std::uint32_t other : reached) blocked_[other] = 1;
}

}  // namespace lamella
