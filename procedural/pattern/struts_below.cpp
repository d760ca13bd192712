// One strut after the other, the lowest piece first.
#include "procedural/pattern/struts_below.h"

#include <algorithm>
#include <utility>

#include "procedural/pattern/printable_pattern.h"

namespace lamella {

std::vector<SiteLine> struts_below(const SurfaceSites& sites, const HangingPieces& pieces,
                                   std::span<const float> distances, double apart) {
    const CarriedDistance pattern(sites, distances);
    std::vector<SiteLine> struts;
    for (const std::uint32_t sample : pieces.find(pattern)) {
        const auto is_near = [&](const SiteLine& other) {
            const dvec3 way = sites.way(sites.places[pieces.site(sample)], other.front().place);
            return glm::dot(way, way) < apart * apart;
        };
        if (std::ranges::any_of(struts, is_near)) continue;
        SiteLine line;
        for (const std::uint32_t site : pieces.way_down(pattern, sample))
            line.push_back({site, sites.places[site]});
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

std::size_t StrutsBelow::complete(double strut, double limit, std::vector<float>& distances) const {
    constexpr int most_rounds = 32;
    std::size_t added = 0;
    for (int round = 0; round < most_rounds; ++round) {
        const std::vector<SiteLine> lines = missing(distances);
        if (lines.empty()) break;
        added += lines.size();
        add_struts(sites_, lines, strut, distances);
        distances = signed_distances(sites_, distances, limit);
    }
    return added;
}

}  // namespace lamella
