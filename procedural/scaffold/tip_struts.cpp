// Marches down from a tip in directions of a fan.
#include "procedural/scaffold/tip_struts.h"

#include <cmath>
#include <numbers>

namespace lamella {

namespace {

constexpr int tilts = 4, turns = 16;
constexpr double steps_in_a_radius = 8;

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

}  // namespace lamella
