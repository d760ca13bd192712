// The nearest points of the border are handed from neighbour to neighbour, in order of their distance.
#include "procedural/pattern/site_distance.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <queue>
#include <utility>

namespace lamella {

namespace {

class FootPropagation {
  public:
    FootPropagation(const SurfaceSites& sites, double limit)
        : sites_(sites), feet_(sites.size()), squares_(sites.size(), limit * limit) {}

    /// Proposes a point as the nearest one to a site.
    void propose(std::size_t site, dvec3 foot) {
        const dvec3 way = sites_.way(sites_.places[site], foot);
        const double square = glm::dot(way, way);
        if (!(square < squares_[site])) return;
        squares_[site] = square;
        feet_[site] = foot;
        open_.push(entry(site));
    }

    /// Returns the distances of all sites.
    std::vector<double> finish() {
        while (!open_.empty()) {
            const std::uint64_t nearest = open_.top();
            open_.pop();
            const auto site = static_cast<std::uint32_t>(nearest);
            if (nearest != entry(site)) continue;  // it was found to be nearer
            const dvec3 foot = feet_[site];
            for (const std::uint32_t other : sites_.neighbours(site)) propose(other, foot);
        }
        for (double& square : squares_) square = std::sqrt(square);
        return std::move(squares_);
    }

  private:
    /// Returns a site with its distance as a number that orders entries by distance: bits of a positive float
    /// above those of the site.
    std::uint64_t entry(std::size_t site) const {
        constexpr int site_bits = 32;
        const auto square = static_cast<float>(squares_[site]);
        return std::uint64_t{std::bit_cast<std::uint32_t>(square)} << site_bits | site;
    }

    const SurfaceSites& sites_;
    std::vector<dvec3> feet_;
    std::vector<double> squares_;  // of the distances
    std::priority_queue<std::uint64_t, std::vector<std::uint64_t>, std::greater<>> open_;
};

/// Returns whether two sites are neighbours.
bool are_neighbours(const SurfaceSites& sites, std::uint32_t a, std::uint32_t b) {
    return std::ranges::count(sites.neighbours(a), b) > 0;
}

/// Where the border crosses the way from a site to a neighbour.
struct Crossing {
    std::uint32_t neighbour;
    dvec3 way;  ///< from the site, mm
};

/// Proposes points of the border near a site: where it crosses the ways to neighbours, and between them.
/// `crossings` is for reuse.
void propose_border(const SurfaceSites& sites, std::span<const float> values, std::uint32_t site,
                    std::vector<Crossing>& crossings, FootPropagation& feet) {
    crossings.clear();
    const double here = static_cast<double>(values[site]);
    for (const std::uint32_t other : sites.neighbours(site)) {
        const double there = static_cast<double>(values[other]);
        if ((here > 0) == (there > 0)) continue;
        crossings.push_back(
            {other, here / (here - there) * sites.way(sites.places[site], sites.places[other])});
    }
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        const Crossing& crossing = crossings[i];
        feet.propose(site, sites.places[site] + crossing.way);
        feet.propose(crossing.neighbour, sites.places[site] + crossing.way);
        for (std::size_t k = 0; k < i; ++k) {
            if (!are_neighbours(sites, crossing.neighbour, crossings[k].neighbour)) continue;
            for (const double share : {0.25, 0.5, 0.75}) {
                const dvec3 foot =
                    sites.places[site] + crossing.way + share * (crossings[k].way - crossing.way);
                feet.propose(site, foot);
                feet.propose(crossing.neighbour, foot);
                feet.propose(crossings[k].neighbour, foot);
            }
        }
    }
}

}  // namespace

std::vector<float> signed_distances(const SurfaceSites& sites, std::span<const float> values, double limit) {
    FootPropagation feet(sites, limit);
    std::vector<Crossing> crossings;
    for (std::uint32_t i = 0; i < sites.size(); ++i) propose_border(sites, values, i, crossings, feet);
    const std::vector<double> distances = feet.finish();
    std::vector<float> signs;
    signs.reserve(distances.size());
    for (std::size_t i = 0; i < distances.size(); ++i)
        signs.push_back(static_cast<float>(values[i] > 0 ? distances[i] : -distances[i]));
    return signs;
}

std::vector<float> distances_from(const SurfaceSites& sites, std::span<const SitePoint> points,
                                  double limit) {
    FootPropagation feet(sites, limit);
    for (const SitePoint& point : points) feet.propose(point.site, point.place);
    const std::vector<double> distances = feet.finish();
    return {distances.begin(), distances.end()};
}

}  // namespace lamella
