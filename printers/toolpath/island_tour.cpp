// Islands stand for their nearest places; single beads are turned once both neighbours are known.
#include "printers/toolpath/island_tour.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

constexpr std::size_t places_of_a_loop = 8, most_places = 16;

double length_between(dvec2 a, dvec2 b) {
    const dvec2 d = a - b;
    return std::sqrt(d.x * d.x + d.y * d.y);
}

/// Returns the distance between the nearest places of two islands; that of their circles if it is more than
/// `near`: then it is all that a tour needs to know.
double gap(const IslandStop& a, const IslandStop& b, double near) {
    const double apart = length_between(a.center, b.center) - a.radius - b.radius;
    if (apart > near) return apart;
    double least = infinity;
    for (const dvec2 place : a.places) least = std::min(least, b.distance(place));
    return least;
}

/// Turns a bead such that the travels to its begin and from its end to the next island (null for none) cost
/// least: a loop may begin at any point, a line at either end. `arrive` is the cost of travel from where the
/// nozzle is. Returns where the bead ends.
template <class Arrive>
dvec2 turn_between(const Arrive& arrive, const IslandStop* next, const TravelCost& cost, Bead& bead) {
    const auto onward = [&](dvec2 from) { return next != nullptr ? cost(next->distance(from)) : 0.0; };
    if (!bead.closed) {
        const dvec2 first = bead.points.front(), last = bead.points.back();
        if (arrive(last) + onward(first) < arrive(first) + onward(last)) {
            std::ranges::reverse(bead.points);
            std::ranges::reverse(bead.widths);
        }
        return end_of(bead);
    }
    std::size_t best = 0;
    double least = infinity;
    for (std::size_t i = 0; i < bead.points.size(); ++i) {
        const double whole = arrive(bead.points[i]) + onward(bead.points[i]);
        if (whole < least) {
            best = i;
            least = whole;
        }
    }
    begin_at(bead, best);
    return end_of(bead);
}

/// Returns the distance from the nearest end of a bead, or point of a loop, to an island.
double distance_to(const IslandStop& island, const Bead& bead) {
    if (!bead.closed)
        return std::min(island.distance(bead.points.front()), island.distance(bead.points.back()));
    double least = infinity;
    for (const dvec2 point : bead.points) least = std::min(least, island.distance(point));
    return least;
}

}  // namespace

IslandStop::IslandStop(const std::vector<Bead>& beads) {
    for (const Bead& bead : beads) {
        if (places.size() >= most_places) break;
        if (bead.closed) {
            const std::size_t count = std::min(bead.points.size(), places_of_a_loop);
            for (std::size_t i = 0; i < count; ++i)
                places.push_back(bead.points[i * bead.points.size() / count]);
        } else {
            places.push_back(bead.points.front());
            places.push_back(bead.points.back());
        }
    }
    for (const dvec2 place : places) center += place / static_cast<double>(places.size());
    for (const dvec2 place : places) radius = std::max(radius, length_between(center, place));
}

double IslandStop::distance(dvec2 from) const {
    double least = infinity;
    for (const dvec2 place : places) {
        const dvec2 d = place - from;
        least = std::min(least, d.x * d.x + d.y * d.y);
    }
    return std::sqrt(least);
}

std::vector<std::size_t> island_tour(const std::vector<IslandStop>& islands, dvec2 start,
                                     const TravelCost& cost) {
    std::vector<dvec2> centers;
    centers.reserve(islands.size());
    for (const IslandStop& island : islands) centers.push_back(island.center);
    return short_tour(centers, start, [&](std::size_t a, std::size_t b) {
        if (a == islands.size()) return cost(islands[b].distance(start));
        return cost(gap(islands[a], islands[b], cost.retract_from));
    });
}

void append_island(std::span<Bead> beads, Seam seam, const IslandStop* next, const TravelCost& cost,
                   dvec2& at, std::vector<Bead>& out) {
    const auto lines =
        std::stable_partition(beads.begin(), beads.end(), [](const Bead& bead) { return bead.closed; });
    const auto walls = static_cast<std::size_t>(lines - beads.begin());
    const bool ends_in_wall = walls == beads.size();
    if (ends_in_wall && seam != Seam::nearest) return append_nearest(beads, seam, at, out);
    if (next != nullptr) {
        const auto last = std::min_element(
            ends_in_wall ? beads.begin() : lines, beads.end(),
            [&](const Bead& a, const Bead& b) { return distance_to(*next, a) < distance_to(*next, b); });
        std::rotate(last, last + 1, beads.end());
    }
    const std::size_t others = beads.size() - 1;
    append_nearest(beads.first(std::min(walls, others)), seam, at, out);
    if (walls < others) append_nearest(beads.subspan(walls, others - walls), seam, at, out);
    Bead& last = beads.back();
    const bool is_inside = others > 0;  // of the island: no travel there retracts
    const auto arrive = [&](dvec2 to) {
        const double length = length_between(at, to);
        return is_inside ? length : cost(length);
    };
    at = turn_between(arrive, next, cost, last);
    out.push_back(std::move(last));
}

}  // namespace lamella
