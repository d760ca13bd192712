// Places by height; those that begin a piece of what is lower, and how far up that piece stays alone.
#include "procedural/pattern/struts_below.h"

#include <algorithm>
#include <utility>

#include "engine/base/disjoint_sets.h"

namespace lamella {

namespace {

/// Returns how far the skin reaches down below a site, mm.
double reach_below(const SurfaceSites& sites, std::uint32_t site, double depth) {
    return depth * std::max(0.0, sites.normals[site].z);
}

/// Returns the sites where a piece of the solid begins that stays alone for more than a spacing of height:
/// the lowest first, without the lowest of all. At edges, a roof joins the walls below it at its underside
/// already, which the surface does not know: it has to stay alone for its thickness as well.
std::vector<std::uint32_t> beginnings(const SurfaceSites& sites, std::span<const float> distances,
                                      std::span<const double> low, double depth) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
        if (distances[i] > 0) order.push_back(i);
    }
    std::ranges::sort(order, {}, [&](std::uint32_t site) { return std::pair(low[site], site); });
    std::vector<std::uint32_t> rank(sites.size(), static_cast<std::uint32_t>(order.size()));
    for (std::uint32_t r = 0; r < order.size(); ++r) rank[order[r]] = r;
    // A set's representative is its lowest rank: where it began.
    DisjointSets pieces(order.size());
    std::vector<double> alone_until(order.size(), infinity);
    for (std::uint32_t r = 0; r < order.size(); ++r) {
        for (const std::uint32_t other : sites.neighbours(order[r])) {
            if (rank[other] >= r) continue;
            const std::uint32_t a = pieces.find(r), b = pieces.find(rank[other]);
            if (a == b) continue;
            alone_until[std::max(a, b)] = low[order[r]];
            pieces.join(a, b);
        }
    }
    std::vector<std::uint32_t> found;
    for (std::uint32_t r = 1; r < order.size(); ++r) {
        const double least = sites.spacing + reach_below(sites, order[r], depth);
        if (alone_until[r] - low[order[r]] > least) found.push_back(order[r]);
    }
    return found;
}

/// Returns the way down the surface to the next solid; empty if there is none.
SiteLine way_down(const SurfaceSites& sites, std::span<const float> distances, std::span<const double> low,
                  std::uint32_t from) {
    SiteLine line{{from, sites.places[from]}};
    for (std::uint32_t at = from;;) {
        std::uint32_t next = at;
        for (const std::uint32_t other : sites.neighbours(at)) {
            if (low[other] < low[next]) next = other;
        }
        if (next == at) return {};
        line.push_back({next, sites.places[next]});
        if (distances[next] > 0) return line;
        at = next;
    }
}

}  // namespace

std::vector<SiteLine> struts_below(const SurfaceSites& sites, std::span<const float> distances, double depth,
                                   double apart) {
    std::vector<double> low;
    for (std::uint32_t i = 0; i < sites.size(); ++i)
        low.push_back(sites.places[i].z - reach_below(sites, i, depth));
    std::vector<SiteLine> struts;
    for (const std::uint32_t site : beginnings(sites, distances, low, depth)) {
        const auto is_near = [&](const SiteLine& other) {
            const dvec3 way = sites.way(sites.places[site], other.front().place);
            return glm::dot(way, way) < apart * apart;
        };
        if (std::ranges::any_of(struts, is_near)) continue;
        SiteLine line = way_down(sites, distances, low, site);
        if (!line.empty()) struts.push_back(std::move(line));
    }
    return struts;
}

std::vector<SiteLine> StrutsBelow::choose(std::span<const float> distances) {
    if (other_ != nullptr) {
        std::vector<SiteLine> chosen = other_->choose(distances);
        if (!chosen.empty()) return chosen;
        other_ = nullptr;
    }
    return struts_below(sites_, distances, depth_, apart_);
}

}  // namespace lamella
