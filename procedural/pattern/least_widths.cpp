// Opening by a disc, and the medial lines of what it loses.
#include "procedural/pattern/least_widths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "procedural/pattern/pattern_pieces.h"
#include "procedural/pattern/site_distance.h"

namespace lamella {

namespace {

/// Parts of a pattern that a disc does not fit in, and the rest.
struct Opening {
    std::vector<float> distances;  ///< of what the disc covers
    SitePieces lost;
};

Opening opened(const SurfaceSites& sites, std::span<const float> distances, double radius, double limit) {
    std::vector<float> deep;
    for (const float d : distances) deep.push_back(d - static_cast<float>(radius));
    const std::vector<float> from_deep = signed_distances(sites, deep, limit);
    Opening opening;
    std::vector<float> lost;
    for (std::size_t i = 0; i < deep.size(); ++i) {
        const float covered = deep[i] > 0 ? distances[i] : static_cast<float>(radius) + from_deep[i];
        opening.distances.push_back(covered);
        lost.push_back(std::min(distances[i], -covered));
    }
    opening.lost = pieces_of(sites, lost);
    return opening;
}

/// Returns by piece of what is lost whether it is a strut.
std::vector<bool> struts_of(const SurfaceSites& sites, const Opening& opening, double radius) {
    const std::size_t count = opening.lost.sizes.size();
    std::vector<bool> is_strut(count, false);
    // Sites of the covered part beside a piece, and how many separate places they are.
    std::vector<std::vector<std::uint32_t>> contacts(count);
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
        const std::uint32_t piece = opening.lost.piece[i];
        if (piece == SitePieces::none) continue;
        if (opening.distances[i] < -static_cast<float>(radius)) is_strut[piece] = true;
        for (const std::uint32_t other : sites.neighbours(i)) {
            if (opening.distances[other] > 0) contacts[piece].push_back(other);
        }
    }
    for (std::size_t piece = 0; piece < count; ++piece) {
        auto& sides = contacts[piece];
        if (is_strut[piece] || sides.empty()) continue;
        std::ranges::sort(sides);
        sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
        std::vector<std::uint32_t> open{sides.front()};
        std::vector<bool> reached(sides.size(), false);
        reached.front() = true;
        std::size_t found = 0;
        while (!open.empty()) {
            const std::uint32_t site = open.back();
            open.pop_back();
            ++found;
            for (const std::uint32_t other : sites.neighbours(site)) {
                const auto at = std::ranges::lower_bound(sides, other);
                const auto place = static_cast<std::size_t>(at - sides.begin());
                if (at == sides.end() || *at != other || reached[place]) continue;
                reached[place] = true;
                open.push_back(other);
            }
        }
        is_strut[piece] = found < sides.size();
    }
    return is_strut;
}

/// Returns the point of the medial line at a site that is at least as deep as both neighbours along some
/// direction, and deeper than one: the top of the parabola through the three, where they are deepest.
std::optional<SitePoint> medial_point(const SurfaceSites& sites, const SiteWindows& windows,
                                      std::span<const float> distances, std::uint32_t site) {
    constexpr std::array<std::array<int, 2>, 4> ways{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
    const auto window = windows.of(site);
    const float here = distances[site];
    std::optional<SitePoint> point;
    float sharpest = 0;
    for (const auto& way : ways) {
        const std::uint32_t back = window[windows.place(-way[0], -way[1])],
                            ahead = window[windows.place(way[0], way[1])];
        const float before = distances[back], after = distances[ahead];
        const float bend = here + here - before - after;
        if (here < before || here < after || !(bend > sharpest)) continue;
        sharpest = bend;
        const double share = 0.5 * static_cast<double>(after - before) / static_cast<double>(bend);
        const dvec3 at = sites.places[site];
        point = {site, at + share * (share > 0 ? sites.way(at, sites.places[ahead])
                                               : -sites.way(at, sites.places[back]))};
    }
    return point;
}

}  // namespace

std::vector<float> with_least_width(const SurfaceSites& sites, const SiteWindows& windows,
                                    std::span<const float> distances, double width) {
    const double radius = 0.5 * width, limit = width + 4 * sites.spacing;
    Opening opening = opened(sites, distances, radius, limit);
    const std::vector<bool> is_strut = struts_of(sites, opening, radius);
    std::vector<SitePoint> line;
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
        const std::uint32_t piece = opening.lost.piece[i];
        if (piece == SitePieces::none || !is_strut[piece]) continue;
        if (const auto point = medial_point(sites, windows, distances, i)) line.push_back(*point);
    }
    const std::vector<float> struts = struts_along(sites, line, width, limit);
    std::vector<float> wide = std::move(opening.distances);
    for (std::size_t i = 0; i < wide.size(); ++i) wide[i] = std::max(wide[i], struts[i]);
    return wide;
}

std::vector<float> struts_along(const SurfaceSites& sites, std::span<const SitePoint> line, double width,
                                double limit) {
    const double half_step = 0.75 * sites.spacing;
    const double radius = std::sqrt(0.25 * width * width + half_step * half_step);
    std::vector<float> distances = distances_from(sites, line, limit);
    for (float& distance : distances) distance = static_cast<float>(radius) - distance;
    return distances;
}

}  // namespace lamella
