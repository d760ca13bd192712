// Ways down are tried ring by ring round the place, nearest first.
#include "procedural/scaffold_legs.h"

#include <array>

#include "engine/deterministic_math.h"

namespace lamella {
namespace {

constexpr int directions = 16;
constexpr double ring_step = 1;  // mm
constexpr double pi = 3.14159265358979323846;
constexpr dvec3 down{0, 0, -1};

dvec2 direction(int k) {
    const SineCosine angle = sine_cosine(2 * pi * k / directions);
    return {angle.cosine, angle.sine};
}

double length_of(const Beam& beam) { return glm::distance(beam.a, beam.b); }

}  // namespace

dvec3 LegFinder::tip_center(dvec3 point) const {
    const double lower = shape_.gap > 0 ? shape_.gap + shape_.tip / 2 : 0;
    return point - dvec3(0, 0, lower);
}

/// The foot shrinks where the part is near.
double LegFinder::foot_radius(dvec2 at) const {
    const dvec3 middle(at, shape_.bed + shape_.foot_height / 2);
    const double wanted = shape_.foot / 2;
    const double room = space_.room(middle, wanted + shape_.clearance) - shape_.clearance;
    return std::max(std::min(wanted, room), shape_.pillar / 2);
}

/// A pillar straight down from a place that is clear of the part.
std::optional<Leg> LegFinder::upright(dvec3 top) const {
    const double half = shape_.pillar / 2, needed = shape_.clearance + half;
    if (top.z <= shape_.bed) return std::nullopt;
    const FreeSpace::Fall fall = space_.fall(top, down, needed);
    if (!fall.passes) return std::nullopt;
    Leg leg;
    const dvec2 at(top);
    if (!fall.hits) {
        leg.pillar = ScaffoldPillar{at, shape_.bed, top.z, foot_radius(at)};
        leg.landing = shape_.bed;
        leg.length = top.z - shape_.bed;
        return leg;
    }
    const double surface = top.z - *fall.hits;
    // The cone on which the pillar stands widens no faster than layers can follow.
    const double widening = std::max(shape_.connector, (half - shape_.tip / 2) / shape_.lean);
    const double bottom = std::max(top.z - fall.clear, surface + widening);
    if (bottom > top.z - shape_.connector) return std::nullopt;
    const Beam cone{dvec3(at, surface), shape_.tip / 2, dvec3(at, bottom), half};
    if (!space_.clear_from_contact(cone.a, cone.b, shape_.clearance)) return std::nullopt;
    leg.connectors.push_back(cone);
    leg.pillar = ScaffoldPillar{at, bottom, top.z, 0};
    leg.landing = surface;
    leg.on_bed = false;
    leg.length = top.z - surface;
    return leg;
}

/// A leaning piece and a pillar under it; straight down first.
std::optional<Leg> LegFinder::best_detour(dvec3 top, double least_rise, double top_radius,
                                          bool contact) const {
    const double radius = connector_radius(), needed = shape_.clearance + radius;
    std::optional<Leg> best;
    for (double ring = 0; ring <= 2 * shape_.reach; ring += ring_step) {
        for (int k = 0; k < (ring == 0 ? 1 : directions); ++k) {
            const double rise = std::max(least_rise, ring / shape_.lean);
            const dvec3 foot = top + dvec3(direction(k) * ring, -rise);
            if (foot.z < shape_.bed + shape_.foot_height) continue;
            if (rise > 0 &&
                !(contact ? space_.clear_from_contact(top, foot, needed) : space_.clear(top, foot, needed))) {
                continue;
            }
            std::optional<Leg> leg = upright(foot);
            if (!leg) continue;
            if (rise > 0) {
                leg->connectors.push_back({top, top_radius, foot, radius});
                leg->length += length_of(leg->connectors.back());
            }
            if (leg->on_bed) return leg;
            if (!best || leg->length < best->length) best = std::move(leg);
        }
    }
    return best;
}

/// A thin piece, straight or leaning, to whatever lies next below.
std::optional<Leg> LegFinder::strut(dvec3 top, double top_radius, bool contact) const {
    const double radius = connector_radius();
    std::optional<Leg> best;
    for (int ring = 0; ring <= 4; ++ring) {
        const double lean = shape_.lean * ring / 4;
        for (int k = 0; k < (ring == 0 ? 1 : directions); ++k) {
            const dvec3 way = dvec3(direction(k) * lean, -1) / std::sqrt(1 + lean * lean);
            const dvec3 start = contact ? top + way * (2 * shape_.tip) : top;
            if (start.z <= shape_.bed || space_.room(start, radius) <= 0) continue;
            const FreeSpace::Fall fall = space_.fall(start, way, 0);
            const double reached =
                glm::distance(top, start) + fall.hits.value_or((start.z - shape_.bed) / -way.z);
            const dvec3 end = top + way * reached, middle = top + way * (reached / 2);
            const double away = shape_.clearance + radius;
            if (contact && !space_.clear_from_contact(top, middle, away)) continue;
            if (!contact && !space_.clear(top, middle, std::min(away, 0.4 * reached / 2))) continue;
            if (fall.hits ? !space_.clear_from_contact(end, middle, away)
                          : !space_.clear(end, middle, std::min(away, 0.4 * reached / 2))) {
                continue;
            }
            Leg leg;
            const double end_radius = fall.hits ? shape_.tip / 2 : radius;
            if (reached > 2 * shape_.connector) {
                leg.connectors.push_back({top, top_radius, middle, radius});
                leg.connectors.push_back({middle, radius, end, end_radius});
            } else {
                leg.connectors.push_back({top, top_radius, end, end_radius});
            }
            leg.landing = end.z;
            leg.on_bed = !fall.hits;
            leg.length = reached;
            if (!best || (leg.on_bed && !best->on_bed) ||
                (leg.on_bed == best->on_bed && leg.length < best->length)) {
                best = std::move(leg);
            }
        }
        if (best && best->on_bed) break;
    }
    return best;
}

std::optional<Leg> LegFinder::under_point(dvec3 point) const {
    const dvec3 top = tip_center(point);
    if (auto leg = best_detour(top, shape_.connector, shape_.tip / 2, true); leg && leg->on_bed) {
        return leg;
    } else if (leg) {
        // Thin struts leave smaller marks on the part, where they are short.
        auto thin = strut(top, shape_.tip / 2, true);
        const double short_way = 4 * shape_.connector;
        return thin && (thin->on_bed || thin->length < short_way) ? thin : leg;
    }
    return strut(top, shape_.tip / 2, true);
}

std::optional<Leg> LegFinder::under_bar(dvec3 place) const {
    if (auto leg = best_detour(place, 0, connector_radius(), false)) return leg;
    return strut(place, connector_radius(), false);
}

}  // namespace lamella
