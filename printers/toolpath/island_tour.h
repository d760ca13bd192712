// Order of a layer's islands, and where single beads begin, for few retractions.
#pragma once

#include <span>
#include <vector>

#include "printers/toolpath/bead_order.h"

namespace lamella {

/// What a travel between islands costs, mm of travel: one that retracts takes time and leaves a mark.
struct TravelCost {
    static constexpr double retraction = 10;
    double retract_from = 2;  ///< mm

    double operator()(double length) const { return length + (length > retract_from ? retraction : 0); }
};

/// Places of an island where a travel can begin or end: a few points of its loops, and the ends of its lines.
struct IslandStop {
    std::vector<dvec2> places;
    dvec2 center{0};
    double radius = 0;  ///< of a circle around the center that holds all places

    explicit IslandStop(const std::vector<Bead>& beads);
    /// Returns the distance from a point to the nearest place.
    double distance(dvec2 from) const;
};

/// Returns an order in which to visit islands from `start` at a low cost of travel between nearest places:
/// short_tour() of their centers by that cost.
std::vector<std::size_t> island_tour(const std::vector<IslandStop>& islands, dvec2 start,
                                     const TravelCost& cost);

/// Appends the beads of an island to `out`, from `at`, which is updated: walls first, because they hold the
/// rest, in nearest-neighbour order, but for the last one, from which the travel to the next island (null for
/// none) costs least.
void append_island(std::span<Bead> beads, Seam seam, const IslandStop* next, const TravelCost& cost,
                   dvec2& at, std::vector<Bead>& out);

}  // namespace lamella
