// Cuts across narrow struts; ways round gaps.
#include "procedural/pattern/pattern_bridges.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"
#include "procedural/pattern/pattern_pieces.h"
#include "procedural/pattern/solid_parting.h"

namespace lamella {

namespace {

std::vector<float> negated(std::span<const float> values) {
    std::vector<float> other;
    other.reserve(values.size());
    for (const float value : values) other.push_back(-value);
    return other;
}

/// Returns crossings that are at most so wide, the narrowest first, at least `apart` mm from each other.
std::vector<GapCrossing> spread_out(const SurfaceSites& sites, std::vector<GapCrossing> crossings,
                                    double widest, double apart) {
    std::erase_if(crossings, [&](const GapCrossing& c) { return c.width > widest; });
    std::ranges::stable_sort(crossings, {}, &GapCrossing::width);
    SitesApart places(sites, apart);
    std::erase_if(crossings, [&](const GapCrossing& c) {
        if (!places.is_free(c.middle_from)) return true;
        places.take(c.middle_from);
        return false;
    });
    return crossings;
}

class BridgePlanner {
  public:
    BridgePlanner(const SurfaceSites& sites, std::span<const float> distances, const BridgeSettings& settings)
        : sites_(sites),
          distances_(distances),
          settings_(settings),
          gaps_(sites, distances),
          apart_(sites, settings.apart) {}

    BridgePlan plan() {
        hold_parts_twice();
        shorten_detours();
        return std::move(plan_);
    }

  private:
    /// A bridge between a part of the solid and the rest, and how good it is.
    struct Choice {
        const GapCrossing* crossing = nullptr;
        double score = 0;
    };

    void take(const GapCrossing& crossing) {
        plan_.bridges.push_back(gaps_.line(crossing));
        apart_.take(crossing.middle_from);
        chosen_.push_back(crossing);
    }

    /// A strut alone holds a part only if the same gap lies on both of its sides.
    std::vector<GapCrossing> narrow_struts(const GapCrossings& struts, std::span<const float> voids) const {
        const SitePieces gaps = pieces_of(sites_, voids);
        std::vector<GapCrossing> found = struts.all();
        std::erase_if(found, [&](const GapCrossing& c) { return gaps.piece[c.from] != gaps.piece[c.to]; });
        return spread_out(sites_, std::move(found), settings_.widest_strut * settings_.strut,
                          settings_.strut);
    }

    void hold_parts_twice() {
        const std::vector<float> voids = negated(distances_);
        const GapCrossings struts(sites_, voids);
        const std::size_t solid = static_cast<std::size_t>(
            std::ranges::count_if(distances_, [](float distance) { return distance > 0; }));
        const double least = settings_.least_part * static_cast<double>(solid);
        const std::vector<GapCrossing> candidates =
            spread_out(sites_, gaps_.all(), infinity, settings_.strut);
        SolidParting parting(sites_, distances_);
        for (const GapCrossing& strut : narrow_struts(struts, voids)) {
            stop_if_cancelled(settings_.cancel);
            if (static_cast<double>(parting.cut(struts.line(strut))) < std::max(least, 1.0)) continue;
            ++plan_.cut_struts;
            const auto holds = [&](const GapCrossing& c) {
                return parting.in_smaller(c.from) != parting.in_smaller(c.to);
            };
            if (std::ranges::any_of(chosen_, holds)) continue;
            if (const Choice best = second_hold(candidates, parting); best.crossing != nullptr)
                take(*best.crossing);
        }
    }

    /// Returns the crossing by which the smaller part is best held a second time.
    Choice second_hold(std::span<const GapCrossing> candidates, const SolidParting& parting) const {
        constexpr std::uint32_t as_far_as_any = 200;  // steps
        Choice best;
        for (const GapCrossing& c : candidates) {
            if (parting.in_smaller(c.from) == parting.in_smaller(c.to) || !apart_.is_free(c.middle_from))
                continue;
            const double steps = parting.steps(c.from, as_far_as_any) + parting.steps(c.to, as_far_as_any);
            const double score = steps / (c.width + settings_.strut);
            if (score > best.score) best = {&c, score};
        }
        return best;
    }

    void shorten_detours() {
        const std::vector<GapCrossing> crossings =
            spread_out(sites_, gaps_.all(), settings_.widest_gap * settings_.strut, 2 * settings_.strut);
        std::vector<double> spans(crossings.size());  // length of the way round, in widths
        constexpr std::size_t crossings_a_task = 128;
        parallel_for((crossings.size() + crossings_a_task - 1) / crossings_a_task, [&](std::size_t task) {
            SolidWays ways(sites_, distances_);
            const std::size_t end = std::min(crossings.size(), (task + 1) * crossings_a_task);
            for (std::size_t i = task * crossings_a_task; i < end; ++i) {
                stop_if_cancelled(settings_.cancel);
                constexpr double beyond = 2;  // is as bad as any
                const GapCrossing& c = crossings[i];
                const double span = c.width + settings_.strut;
                spans[i] = ways.length(c.from, c.to, beyond * settings_.detour * span) / span;
            }
        });
        struct Detour {
            GapCrossing crossing;
            double share;
        };
        std::vector<Detour> detours;
        for (std::size_t i = 0; i < crossings.size(); ++i) {
            if (spans[i] > settings_.detour) detours.push_back({crossings[i], spans[i]});
        }
        plan_.detours = detours.size();
        std::ranges::stable_sort(detours, std::greater<>(), &Detour::share);
        for (const Detour& detour : detours) {
            if (apart_.is_free(detour.crossing.middle_from)) take(detour.crossing);
        }
    }

    const SurfaceSites& sites_;
    std::span<const float> distances_;
    const BridgeSettings& settings_;
    GapCrossings gaps_;
    SitesApart apart_;
    std::vector<GapCrossing> chosen_;
    BridgePlan plan_;
};

}  // namespace

BridgePlan plan_bridges(const SurfaceSites& sites, std::span<const float> distances,
                        const BridgeSettings& settings) {
    return BridgePlanner(sites, distances, settings).plan();
}

}  // namespace lamella
