// Marches down from a tip in directions of a fan, or level to the places of a grid where the body stands on
// the bed.
#include "procedural/scaffold/tip_struts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <queue>
#include <utility>

namespace lamella {

namespace {

constexpr int tilts = 4, turns = 16;
constexpr double steps_in_a_radius = 8;
constexpr double farthest = 12;  // end of a level strut from its tip, in radii

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

/// Returns whether the body stands on the bed around a place, as far as `around` to each side, mm.
bool stands_on_bed(dvec2 place, double first_plane, const Field& body, double around) {
    for (const dvec2 aside : {dvec2(0), dvec2(1, 0), dvec2(-1, 0), dvec2(0, 1), dvec2(0, -1)}) {
        if (!(body.value(dvec3(place + around * aside, first_plane)) <= 0)) return false;
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

/// A square grid of places at one height around a tip, and the shortest ways over it that stay in the body.
class LevelPaths {
  public:
    LevelPaths(dvec3 tip, double pitch, double reach)
        : tip_(tip),
          pitch_(pitch),
          reach_(reach),
          most_(static_cast<int>(reach / pitch)),
          width_(2 * most_ + 1),
          from_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(width_), unreached) {}

    /// Returns the places of the shortest way from the tip to the nearest place that `is_goal` accepts, both
    /// ends included, and at every step; empty where there is none.
    template <class Goal>
    std::vector<dvec3> to_nearest(const Field& body, const Goal& is_goal) {
        using Way = std::pair<double, int>;  // length, mm; index of its end
        std::priority_queue<Way, std::vector<Way>, std::greater<>> open;
        std::vector<double> length(from_.size(), reach_);
        const int start = most_ * width_ + most_;
        from_[static_cast<std::size_t>(start)] = start;
        length[static_cast<std::size_t>(start)] = 0;
        open.emplace(0.0, start);
        while (!open.empty()) {
            const auto [way, at] = open.top();
            open.pop();
            if (way > length[static_cast<std::size_t>(at)] || !(body.value(place(at)) <= 0)) continue;
            if (is_goal(place(at))) return traced(at);
            for (const glm::ivec2 turn : compass) {
                const glm::ivec2 next = glm::ivec2(at % width_, at / width_) + turn;
                if (std::min(next.x, next.y) < 0 || std::max(next.x, next.y) >= width_) continue;
                const int index = next.y * width_ + next.x;
                const double longer = way + pitch_ * glm::length(dvec2(turn));
                if (longer >= length[static_cast<std::size_t>(index)]) continue;
                length[static_cast<std::size_t>(index)] = longer;
                from_[static_cast<std::size_t>(index)] = at;
                open.emplace(longer, index);
            }
        }
        return {};
    }

  private:
    static constexpr int unreached = -1;
    static constexpr glm::ivec2 compass[] = {{1, 0}, {0, 1},  {-1, 0},  {0, -1},
                                             {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};

    dvec3 place(int index) const {
        return tip_ + pitch_ * dvec3(index % width_ - most_, index / width_ - most_, 0);
    }

    std::vector<dvec3> traced(int end) const {
        std::vector<dvec3> way{place(end)};
        for (int at = end; from_[static_cast<std::size_t>(at)] != at;) {
            at = from_[static_cast<std::size_t>(at)];
            way.push_back(place(at));
        }
        std::ranges::reverse(way);
        return way;
    }

    dvec3 tip_;
    double pitch_, reach_;
    int most_, width_;
    std::vector<int> from_;  // index of the place before it on its way; the tip's own
};

/// Returns the ends and bends of a way, with straight legs that stay in the body.
std::vector<dvec3> straightened(const std::vector<dvec3>& way, const Field& body, double step) {
    std::vector<dvec3> bends{way.front()};
    for (std::size_t i = 1; i < way.size(); ++i) {
        if (!stays_in(body, bends.back(), way[i], step)) bends.push_back(way[i - 1]);
    }
    bends.push_back(way.back());
    return bends;
}

/// Returns struts along the shortest level way from a tip to a place that `is_goal` accepts; none where
/// there is no such way.
template <class Goal>
std::vector<Beam> level_legs(dvec3 tip, const Field& body, const TipStrutOptions& options,
                             const Goal& is_goal) {
    const double step = options.radius / steps_in_a_radius;
    LevelPaths paths(tip, step, std::min(options.reach, farthest * options.radius));
    const auto way = paths.to_nearest(body, is_goal);
    if (way.empty()) return {};
    const std::vector<dvec3> bends = straightened(way, body, step);
    std::vector<Beam> legs;
    legs.reserve(bends.size() - 1);
    for (std::size_t i = 0; i + 1 < bends.size(); ++i)
        legs.push_back({bends[i], options.radius, bends[i + 1], options.radius});
    return legs;
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

std::vector<Beam> struts_to_bed(dvec3 tip, double first_plane, const Field& body,
                                const TipStrutOptions& options) {
    if (tip.z - first_plane > 0.5 * options.radius) return {};
    const double around = 0.5 * options.radius / steps_in_a_radius;
    std::vector<Beam> legs = level_legs(tip, body, options, [&](dvec3 place) {
        return stands_on_bed(dvec2(place), first_plane, body, around);
    });
    if (legs.empty()) return {};
    legs.back().b.z = first_plane - 0.5 * options.layer_height;
    return legs;
}

std::vector<Beam> struts_aside(dvec3 tip, const Field& part, const Field& body,
                               const TipStrutOptions& options) {
    const auto stands = [&](dvec3 place) {
        for (double below = 0; below < options.radius; below += options.layer_height) {
            if (!(part.value(place - dvec3(0, 0, below)) <= 0)) return false;
        }
        return true;
    };
    return level_legs(tip, body, options, stands);
}

}  // namespace lamella
