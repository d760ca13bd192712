// Breadth-first floods in turns, and A* search.
#include "procedural/pattern/solid_parting.h"

#include <cmath>
#include <queue>
#include <utility>

namespace lamella {

namespace {

constexpr int in_the_cut = 3;

}  // namespace

SolidParting::SolidParting(const SurfaceSites& sites, std::span<const float> values)
    : sites_(sites),
      values_(values),
      stamp_(sites.size(), 0),
      steps_(sites.size(), 0),
      part_(sites.size(), 0),
      fronts_(2) {}

/// Marks a site that no part has yet; returns false otherwise.
bool SolidParting::mark(std::uint32_t site, int part, std::uint32_t steps) {
    if (stamp_[site] == now_) return false;
    stamp_[site] = now_;
    part_[site] = static_cast<std::uint8_t>(part);
    steps_[site] = steps;
    if (part != in_the_cut) fronts_[static_cast<std::size_t>(part - 1)].sites.push_back(site);
    return true;
}

/// Takes the sites of the cut away, and begins on both of its sides.
void SolidParting::begin(std::span<const SitePoint> line) {
    ++now_;
    met_ = false;
    for (Front& front : fronts_) front = {};
    std::vector<std::uint32_t> cut;
    const auto take_away = [&](std::uint32_t site) {
        if (values_[site] > 0 && mark(site, in_the_cut, 0)) cut.push_back(site);
    };
    // Neighbours touch across edges: a line of sites alone lets them pass.
    for (const SitePoint& point : line) {
        take_away(point.site);
        for (const std::uint32_t other : sites_.neighbours(point.site)) take_away(other);
    }
    const dvec3 first = line.front().place, along = sites_.way(first, line.back().place);
    for (const std::uint32_t site : cut) {
        for (const std::uint32_t other : sites_.neighbours(site)) {
            if (!(values_[other] > 0) || stamp_[other] == now_) continue;
            const dvec3 way = sites_.way(first, sites_.places[other]);
            mark(other, glm::dot(glm::cross(sites_.normals[site], along), way) > 0 ? 1 : 2, 1);
        }
    }
}

/// Looks at the neighbours of one site of a front; returns false when there is none left.
bool SolidParting::advance(int part) {
    Front& front = fronts_[static_cast<std::size_t>(part - 1)];
    if (front.done == front.sites.size()) return false;
    const std::uint32_t site = front.sites[front.done++];
    for (const std::uint32_t other : sites_.neighbours(site)) {
        if (!(values_[other] > 0)) continue;
        if (stamp_[other] == now_ && part_[other] == 3 - part) met_ = true;
        mark(other, part, steps_[site] + 1);
    }
    return true;
}

std::size_t SolidParting::cut(std::span<const SitePoint> line) {
    begin(line);
    while (!met_ && advance(1) && advance(2)) {
    }
    if (met_) return 0;
    smaller_ = fronts_[0].done == fronts_[0].sites.size() ? 1 : 2;
    return fronts_[static_cast<std::size_t>(smaller_ - 1)].sites.size();
}

SolidWays::SolidWays(const SurfaceSites& sites, std::span<const float> values)
    : sites_(sites), values_(values), stamp_(sites.size(), 0), length_(sites.size(), 0) {}

double SolidWays::length(std::uint32_t from, std::uint32_t to, double limit) {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    ++now_;
    const auto propose = [&](std::uint32_t site, double way) {
        const double least = way + lamella::length(sites_.way(sites_.places[site], sites_.places[to]));
        if (!(least < limit) || (stamp_[site] == now_ && !(way < length_[site]))) return;
        stamp_[site] = now_;
        length_[site] = way;
        open.emplace(least, site);
    };
    propose(from, 0);
    while (!open.empty()) {
        const std::uint32_t site = open.top().second;
        if (site == to) return length_[to];
        open.pop();
        for (const std::uint32_t other : sites_.neighbours(site)) {
            if (values_[other] > 0)
                propose(other, length_[site] +
                                   lamella::length(sites_.way(sites_.places[site], sites_.places[other])));
        }
    }
    return limit;
}

}  // namespace lamella
