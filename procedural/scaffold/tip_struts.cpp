// Marches down from a tip in directions of a fan, or level to the places of a grid where the body stands on
// the bed.
#include "procedural/scaffold/tip_struts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lamella {

namespace {

constexpr int tilts = 4, turns = 16;
constexpr double steps_in_a_radius = 8;
constexpr double farthest_foot = 12;  // from its tip, in radii

/// Returns how far the part is from the tip in a direction, up to `reach`; nothing where the way leaves the
/// body or ends in too little solid.
std::optional<double> way_down(dvec3 tip, dvec3 direction, const Field& part, const Field& body,
                               const TipStrutOptions& options, double reach) {
    const double step = options.radius / steps_in_a_radius;
    const double clear = options.layer_height / -direction.z;  // up to there, solid may be the tip's
    double landed = 0, solid = 0;
    for (double way = step; way <= reach + options.radius; way += step) {
        const dvec3 at = tip + way * direction;
        if (!(body.value(at) <= 0)) return {};
        if (way < clear) continue;
        if (!(part.value(at) <= 0)) {
            if (way > reach) return {};
            solid = 0;
            continue;
        }
        if (solid == 0) landed = way;
        solid += step;
        if (solid >= options.radius) return landed;
    }
    return {};
}

/// Returns whether the body stands on the bed around a place, an eighth of the radius to each side.
bool stands_on_bed(dvec2 place, double first_plane, const Field& body, double radius) {
    for (const dvec2 aside : {dvec2(0), dvec2(1, 0), dvec2(-1, 0), dvec2(0, 1), dvec2(0, -1)}) {
        if (!(body.value(dvec3(place + radius / steps_in_a_radius * aside, first_plane)) <= 0)) return false;
    }
    return true;
}

/// Returns whether the straight way from a to b stays in the body, at steps of this size.
bool stays_in(const Field& body, dvec3 a, dvec3 b, double step) {
    const int steps = static_cast<int>(std::ceil(glm::length(b - a) / step));
    for (int i = 0; i <= steps; ++i) {
        const double along = steps > 0 ? static_cast<double>(i) / steps : 0.0;
        if (!(body.value(a + along * (b - a)) <= 0)) return false;
    }
    return true;
}

/// Returns the places of a square grid around the origin up to a distance, nearest first.
std::vector<dvec2> grid_around(double pitch, double reach) {
    const int most = static_cast<int>(reach / pitch);
    std::vector<dvec2> places;
    for (int y = -most; y <= most; ++y) {
        for (int x = -most; x <= most; ++x) {
            const dvec2 place = pitch * dvec2(x, y);
            if (glm::length(place) <= reach) places.push_back(place);
        }
    }
    std::ranges::stable_sort(places, {}, [](dvec2 place) { return glm::dot(place, place); });
    return places;
}

}  // namespace

std::optional<Beam> strut_below(dvec3 tip, const Field& part, const Field& body,
                                const TipStrutOptions& options) {
    std::optional<Beam> best;
    double reach = options.reach;
    for (int tilt = 0; tilt <= tilts; ++tilt) {
        const double angle = tilt * std::numbers::pi / 4 / tilts;
        for (int turn = 0; turn < (tilt == 0 ? 1 : turns); ++turn) {
            const double around = turn * 2 * std::numbers::pi / turns;
            const dvec3 direction(std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around),
                                  -std::cos(angle));
            const auto way = way_down(tip, direction, part, body, options, reach);
            if (!way) continue;
            reach = *way;
            const double foot = 0.5 * options.radius;
            best = Beam{tip, options.radius, tip + (*way + foot) * direction, foot};
        }
    }
    return best;
}

std::optional<Beam> strut_to_bed(dvec3 tip, double first_plane, const Field& body,
                                 const TipStrutOptions& options) {
    if (tip.z - first_plane > 0.5 * options.radius) return {};
    const double bed = first_plane - 0.5 * options.layer_height;
    const double step = options.radius / steps_in_a_radius;
    for (const dvec2 aside : grid_around(step, std::min(options.reach, farthest_foot * options.radius))) {
        const dvec2 foot = dvec2(tip) + aside;
        if (stands_on_bed(foot, first_plane, body, options.radius) &&
            stays_in(body, tip, dvec3(foot, tip.z), step))
            return Beam{tip, options.radius, dvec3(foot, bed), 0.5 * options.radius};
    }
    return {};
}

}  // namespace lamella
