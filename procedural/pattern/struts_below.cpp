// Ways of steepest descent over the sites.
#include "procedural/pattern/struts_below.h"

#include <algorithm>
#include <utility>

namespace lamella {

namespace {

/// Returns the way down the surface, over void, to the next solid; empty if there is none.
SiteLine way_down(const SurfaceSites& sites, std::span<const float> distances, std::uint32_t from) {
    const double flat = 1e-3 * sites.spacing;
    SiteLine line{{from, sites.places[from]}};
    bool is_over_void = !(distances[from] > 0);
    for (std::uint32_t at = from;;) {
        std::uint32_t next = at;
        for (const std::uint32_t other : sites.neighbours(at)) {
            if (sites.places[other].z < sites.places[next].z) next = other;
        }
        if (!(sites.places[at].z - sites.places[next].z > flat)) return {};
        line.push_back({next, sites.places[next]});
        if (distances[next] > 0 && is_over_void) return line;
        is_over_void |= !(distances[next] > 0);
        at = next;
    }
}

}  // namespace

std::vector<SiteLine> struts_below(const SurfaceSites& sites, std::span<const float> distances,
                                   std::span<const std::uint32_t> hanging, double apart) {
    std::vector<SiteLine> struts;
    for (const std::uint32_t site : hanging) {
        const auto is_near = [&](const SiteLine& other) {
            const dvec3 way = sites.way(sites.places[site], other.front().place);
            return glm::dot(way, way) < apart * apart;
        };
        if (std::ranges::any_of(struts, is_near)) continue;
        SiteLine line = way_down(sites, distances, site);
        if (!line.empty()) struts.push_back(std::move(line));
    }
    return struts;
}

std::vector<SiteLine> StrutsBelow::choose(std::span<const float> distances) {
    constexpr int most = 5;  // struts need the other rounds of sound_pattern()
    if (other_ != nullptr && asked_++ < most) {
        std::vector<SiteLine> chosen = other_->choose(distances);
        if (!chosen.empty()) return chosen;
    }
    other_ = nullptr;
    return missing(distances);
}

}  // namespace lamella
