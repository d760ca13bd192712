// Tries routes in rings around a place, nearest first.
#include "procedural/scaffold/support_router.h"

#include <array>
#include <span>

#include "engine/base/deterministic_math.h"

namespace lamella {
namespace {

/// Detours to try: their distance, and the number of directions.
struct Ring {
    double share_of_reach;
    int ways;
};
/// A point must be supported. A bar may be placed elsewhere, so fewer of its detours are worth the time.
constexpr std::array<Ring, 5> rings_about_points{{{0, 1}, {0.25, 8}, {0.5, 8}, {1, 16}, {2, 16}}};
constexpr std::array<Ring, 3> rings_about_bars{{{0, 1}, {0.75, 8}, {1.5, 8}}};
constexpr std::array<Ring, 4> leans_of_struts{
    {{0, 1}, {0.35, 8}, {0.7, 8}, {1, 16}}};  // as shares of the maximum lean
/// For points that the rings above do not help.
constexpr std::array<Ring, 10> many_leans{{{0, 1},
                                           {0.1, 8},
                                           {0.2, 16},
                                           {0.3, 16},
                                           {0.4, 24},
                                           {0.5, 24},
                                           {0.6, 32},
                                           {0.7, 32},
                                           {0.85, 32},
                                           {1, 32}}};
constexpr double contact_slope = 0.4;  // minimum clearance of struts near their ends, per mm of length
constexpr dvec3 down{0, 0, -1};

dvec2 direction(int k, int ways) {
    const SineCosine angle = sine_cosine(2 * pi * k / ways);
    return {angle.cosine, angle.sine};
}

double length_of(const Beam& beam) { return glm::distance(beam.a, beam.b); }

}  // namespace

dvec3 SupportRouter::tip_center(dvec3 point) const {
    const double lower = shape_.gap > 0 ? shape_.gap + shape_.tip / 2 : 0;
    return point - dvec3(0, 0, lower);
}

/// Returns the radius of a pillar's foot. The foot is smaller near the part, and under low pillars, which are
/// not likely to tip over.
double SupportRouter::foot_radius_on_bed(dvec2 at, double height) const {
    constexpr double slope = 0.25;  // of the line from the foot's border to the top
    const double wanted = std::min(shape_.foot / 2, shape_.pillar / 2 + slope * height);
    const dvec3 middle(at, shape_.bed + shape_.foot_height / 2);
    return space_.clearance(middle, wanted + shape_.clearance) - shape_.clearance;
}

/// Returns whether the part's surface at a place is level enough to stand on.
bool SupportRouter::level_enough(dvec3 place) const {
    const double below = connector_radius();
    return space_.clearance(place - dvec3(0, 0, below), below) < -0.5 * below;
}

/// Returns the highest layer boundary that is not above z.
double SupportRouter::layer_below(double z) const {
    constexpr double share_of_layer = 1e-6;
    const double layers = std::floor((z - shape_.bed) / shape_.layer_height + share_of_layer);
    return shape_.bed + layers * shape_.layer_height;
}

/// Returns the radius at the lower end of a leaning piece with radius `upper` at its upper end. Tapers to a
/// thin end as far as its underside does not exceed the maximum lean.
double SupportRouter::foot_radius(double upper, double length, dvec3 way) const {
    const double cosine = -way.z, sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double max_cosine = 1 / std::sqrt(1 + shape_.lean * shape_.lean);
    const double sine_left = shape_.lean * max_cosine * cosine - max_cosine * sine;
    const double thinnest = upper - length * std::max(0.0, sine_left);
    return std::min(upper, std::max(shape_.tip / 2, thinnest));
}

/// Returns a pillar straight down from a place that is clear of the part.
std::optional<Leg> SupportRouter::upright(dvec3 top) const {
    const double half = shape_.pillar / 2, needed = shape_.clearance + half;
    if (top.z <= shape_.bed) return std::nullopt;
    const FreeSpace::Fall fall = space_.fall(top, down, needed);
    if (!fall.passes) return std::nullopt;
    Leg leg;
    const dvec2 at(top);
    if (!fall.hits) {
        leg.pillar =
            ScaffoldPillar{at, shape_.bed, top.z, std::max(foot_radius_on_bed(at, top.z - shape_.bed), half)};
        leg.landing = shape_.bed;
        leg.length = top.z - shape_.bed;
        return leg;
    }
    const double surface = top.z - *fall.hits;
    if (!level_enough({at, surface})) return std::nullopt;
    // The pillar stands on a cone. The cone widens no faster than the maximum lean, and needs a level
    // surface.
    const double sine = shape_.lean / std::sqrt(1 + shape_.lean * shape_.lean);
    const double widening = std::max(shape_.connector, (half - shape_.tip / 2) / sine);
    const double bottom = layer_below(std::max(top.z - fall.clear, surface + widening)) + shape_.layer_height;
    if (bottom > top.z - shape_.connector || bottom > surface + 2 * widening) return std::nullopt;
    const Beam cone{dvec3(at, surface), shape_.tip / 2, dvec3(at, bottom), half};
    if (!space_.clear_from_contact(cone.a, cone.b, needed, 0.7)) return std::nullopt;
    leg.connectors.push_back(cone);
    leg.pillar = ScaffoldPillar{at, bottom, top.z, 0};
    leg.landing = surface;
    leg.on_bed = false;
    leg.length = top.z - surface;
    return leg;
}

/// Returns the best leg of a leaning piece with a pillar under it. Tries straight down first.
std::optional<Leg> SupportRouter::best_detour(dvec3 top, double min_rise, double top_radius,
                                              bool contact) const {
    const std::span<const Ring> rings =
        contact ? std::span<const Ring>(rings_about_points) : std::span<const Ring>(rings_about_bars);
    const double radius = connector_radius(), needed = shape_.clearance + radius;
    std::optional<Leg> best;
    for (const Ring& ring : rings) {
        const double lateral = ring.share_of_reach * shape_.reach;
        for (int k = 0; k < ring.ways; ++k) {
            const double rise = std::max(min_rise, lateral / shape_.lean);
            const dvec2 at = dvec2(top) + direction(k, ring.ways) * lateral;
            const dvec3 foot(at, rise > 0 ? layer_below(top.z - rise) : top.z);
            if (foot.z < shape_.bed + shape_.foot_height) continue;
            const double room_for_pillar = shape_.clearance + shape_.pillar / 2;
            if (space_.clearance(foot, room_for_pillar) < room_for_pillar) continue;
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

/// Returns the distance from a contact at which there is certainly clearance; none if there is no such
/// distance nearby.
std::optional<double> SupportRouter::leaves_part(dvec3 contact, dvec3 way, double longest) const {
    for (const double left : {0.2, 0.5, 1.0}) {
        const double at = std::min(left, longest / 2);
        if (space_.clearance(contact + way * at, 0.2) > 0.1 * left) return at;
    }
    return std::nullopt;
}

/// Returns a thin strut from a place, in a downward unit direction, to the first thing it meets.
std::optional<Leg> SupportRouter::strut_along(dvec3 top, dvec3 way, bool contact) const {
    const double radius = connector_radius(), away = shape_.clearance + radius;
    const double to_bed = (top.z - shape_.bed) / -way.z;
    if (!(to_bed > 0)) return std::nullopt;
    const std::optional<double> left = contact ? leaves_part(top, way, to_bed) : 0;
    if (!left) return std::nullopt;
    const dvec3 start = top + way * *left;
    const FreeSpace::Fall fall = space_.fall(start, way, 0);
    const double length = fall.hits ? *left + *fall.hits : to_bed;
    const dvec3 end = top + way * length, middle = top + way * (length / 2);
    if (fall.hits && !level_enough(end)) return std::nullopt;
    const double near_ends = std::min(away, contact_slope * length / 2);
    const bool clear =
        (contact ? space_.clear_from_contact(top, middle, away) : space_.clear(top, middle, near_ends)) &&
        (fall.hits ? space_.clear_from_contact(end, middle, away) : space_.clear(end, middle, near_ends));
    if (!clear) return std::nullopt;
    Leg leg;
    const double top_radius = contact ? shape_.tip / 2 : radius;
    const bool long_enough = length > 2 * shape_.connector;  // long enough to be thicker halfway
    double end_radius = radius;
    if (fall.hits) {
        end_radius =
            long_enough ? foot_radius(radius, length / 2, way) : foot_radius(top_radius, length, way);
    }
    if (long_enough) {
        leg.connectors = {{top, top_radius, middle, radius}, {middle, radius, end, end_radius}};
    } else {
        leg.connectors = {{top, top_radius, end, end_radius}};
    }
    leg.landing = end.z;
    leg.on_bed = !fall.hits;
    leg.length = length;
    if (leg.on_bed && long_enough) {
        const double foot = foot_radius_on_bed(dvec2(end), length);
        const double top_of_foot = shape_.bed + shape_.foot_height;
        if (foot >= shape_.pillar / 2) leg.pillar = ScaffoldPillar{dvec2(end), shape_.bed, top_of_foot, foot};
    }
    return leg;
}

/// Returns the shortest thin strut, straight or leaning, no longer than `longest`; prefers one that reaches
/// the bed.
std::optional<Leg> SupportRouter::strut(dvec3 top, double longest, bool contact) const {
    std::optional<Leg> best;
    const std::span<const Ring> rings =
        longest < infinity ? std::span<const Ring>(leans_of_struts) : std::span<const Ring>(many_leans);
    for (const Ring& ring : rings) {
        const double lean = shape_.lean * ring.share_of_reach;
        for (int k = 0; k < ring.ways; ++k) {
            const dvec3 way = dvec3(direction(k, ring.ways) * lean, -1) / std::sqrt(1 + lean * lean);
            std::optional<Leg> leg = strut_along(top, way, contact);
            if (!leg || leg->length > longest) continue;
            const bool better =
                !best || (leg->on_bed == best->on_bed ? leg->length < best->length : leg->on_bed);
            if (better) best = std::move(leg);
        }
        if (best && best->on_bed) break;
    }
    return best;
}

/// Returns a post straight down to the bed from one or two layers above it, where nothing can be in between.
Leg SupportRouter::post(dvec3 top) const {
    Leg leg;
    const dvec3 end(top.x, top.y, shape_.bed);
    leg.connectors = {{top, shape_.tip / 2, end, shape_.tip / 2}};
    leg.landing = shape_.bed;
    leg.length = top.z - shape_.bed;
    return leg;
}

std::optional<Leg> SupportRouter::under_point(dvec3 point) const {
    const dvec3 top = tip_center(point);
    if (top.z - shape_.bed < 2.5 * shape_.layer_height) return post(top);
    std::optional<Leg> leg = best_detour(top, shape_.connector, shape_.tip / 2, true);
    if (leg && leg->on_bed) return leg;
    // Short thin struts leave smaller marks on the part than pillars.
    std::optional<Leg> thin = strut(top, 2 * shape_.longest_connector, true);
    if (thin && (!leg || thin->length < shape_.longest_connector)) return thin;
    return leg ? leg : strut(top, infinity, true);
}

std::optional<Leg> SupportRouter::under_bar(dvec3 place) const {
    if (auto leg = best_detour(place, 0, connector_radius(), false)) return leg;
    return strut(place, 2 * shape_.longest_connector, false);
}

}  // namespace lamella
