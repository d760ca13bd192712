// Overhang spans: the hanging part of a layer on a lattice, its regions by flood fill, and straight lines
// through each.
#include "engine/surveys/overhang_spans.h"

namespace lamella {
namespace {

/// The states of a node: void, carried, near the outline (left to its path), hanging, and visited.
enum : std::uint8_t { none, hold, edge, hanging, visited };

struct SpanNode {
    int x, y;
};

/// A lattice over the hanging regions of a layer and their surroundings.
class HangingLattice {
  public:
    HangingLattice(const SurveyedLayer& layer, const RunRows& hang, const SurveyResolution& by)
        : band_(by.band),
          pitches_(std::max(1, static_cast<int>(std::lround(by.width / by.band.across_pitch)))) {
        int x0 = INT32_MAX, x1 = INT32_MIN, y0 = INT32_MAX, y1 = INT32_MIN;
        each_run(hang, 0, (band_.count - 1) / pitches_, [&](int y, int from, int to) {
            x0 = std::min(x0, from);
            x1 = std::max(x1, to);
            y0 = std::min(y0, y);
            y1 = std::max(y1, y);
        });
        if (x0 > x1) return;
        constexpr int margin = 2;  // nodes, for the carried parts around
        first_ = {x0 - margin, y0 - margin};
        nx_ = x1 - x0 + 1 + 2 * margin;
        ny_ = y1 - y0 + 1 + 2 * margin;
        states_.assign(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_), none);
        fill(layer.rows, hold);
        fill(hang, hanging);
        for (int y = 0; y < ny_; ++y) {
            for (int x = 0; x < nx_; ++x) {
                if (at({x, y}) == hanging && layer.border.distance(place({x, y}), by.width))
                    at({x, y}) = edge;
            }
        }
    }

    bool empty() const { return states_.empty(); }
    int columns() const { return nx_; }
    int lines() const { return ny_; }
    double step() const { return pitches_ * band_.across_pitch; }
    bool inside(SpanNode n) const { return n.x >= 0 && n.x < nx_ && n.y >= 0 && n.y < ny_; }
    std::uint8_t& at(SpanNode n) { return states_[number(n)]; }
    std::uint8_t at(SpanNode n) const { return states_[number(n)]; }
    dvec2 place(SpanNode n) const {
        return {band_.along(unit_of(n.x + first_.x)), band_.line(row_of(n.y + first_.y))};
    }

  private:
    std::size_t number(SpanNode n) const {
        return static_cast<std::size_t>(n.y) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(n.x);
    }
    int row_of(int y) const { return y * pitches_ + pitches_ / 2; }
    double unit_of(int x) const { return (x + 0.5) * pitches_ * run_unit; }

    /// Calls act(y, from, to) for the nodes of every run in lines [first, last], both ends inclusive.
    template <typename Act>
    void each_run(const RunRows& rows, int first, int last, const Act& act) const {
        for (int y = std::max(first, 0); y <= last && row_of(y) < band_.count; ++y) {
            for (const Run& run : rows.line(static_cast<std::size_t>(row_of(y)))) {
                const double unit = static_cast<double>(pitches_) * run_unit;
                const int from = static_cast<int>(std::ceil(run.begin / unit - 0.5)),
                          to = static_cast<int>(std::ceil(run.end / unit - 0.5)) - 1;
                if (from <= to) act(y, from, to);
            }
        }
    }
    void fill(const RunRows& rows, std::uint8_t state) {
        each_run(rows, first_.y, first_.y + ny_ - 1, [&](int y, int from, int to) {
            from = std::max(from - first_.x, 0);
            to = std::min(to - first_.x, nx_ - 1);
            for (int x = from; x <= to; ++x) at({x, y - first_.y}) = state;
        });
    }

    const RowBand& band_;
    int pitches_;  ///< row pitches from node to node
    SpanNode first_{0, 0};
    int nx_ = 0, ny_ = 0;
    std::vector<std::uint8_t> states_;
};

/// Returns the region of a node by a flood fill over all eight neighbours, and marks it visited.
std::vector<SpanNode> region_of(HangingLattice& lattice, SpanNode from) {
    std::vector<SpanNode> region{from};
    lattice.at(from) = visited;
    for (std::size_t k = 0; k < region.size(); ++k) {
        const SpanNode n = region[k];
        for (int y = n.y - 1; y <= n.y + 1; ++y) {
            for (int x = n.x - 1; x <= n.x + 1; ++x) {
                if (!lattice.inside({x, y}) || lattice.at({x, y}) != hanging) continue;
                lattice.at({x, y}) = visited;
                region.push_back({x, y});
            }
        }
    }
    return region;
}

/// Returns true if a node is next to a hanging one. A line along a slanted outline steps on void nodes beside
/// it; these do not end the line.
bool beside_hanging(const HangingLattice& lattice, SpanNode n) {
    for (int y = n.y - 1; y <= n.y + 1; ++y) {
        for (int x = n.x - 1; x <= n.x + 1; ++x) {
            if (lattice.inside({x, y}) && lattice.at({x, y}) >= edge) return true;
        }
    }
    return false;
}

/// Returns the number of steps from a node to a carried one; `most` + 1 if the line ends in the void or is
/// longer.
int steps_to_hold(const HangingLattice& lattice, SpanNode from, dvec2 way, int most) {
    for (int k = 1; k <= most; ++k) {
        const SpanNode n{from.x + static_cast<int>(std::floor(way.x * k + 0.5)),
                         from.y + static_cast<int>(std::floor(way.y * k + 0.5))};
        if (!lattice.inside(n)) return most + 1;
        const std::uint8_t state = lattice.at(n);
        if (state == hold) return k;
        if (state == none && !beside_hanging(lattice, n)) return most + 1;
    }
    return most + 1;
}

bool bridged(const HangingLattice& lattice, const std::vector<SpanNode>& region, dvec2 way, double bridge) {
    const int most = static_cast<int>(std::min(bridge / lattice.step(), 1e6)) + 1;
    for (const SpanNode n : region) {
        const int ahead = steps_to_hold(lattice, n, way, most);
        if (ahead > most || ahead + steps_to_hold(lattice, n, -way, most) > most) return false;
    }
    return true;
}

double extent(const std::vector<SpanNode>& region, double step) {
    int x0 = region[0].x, x1 = x0, y0 = region[0].y, y1 = y0;
    for (const SpanNode n : region) {
        x0 = std::min(x0, n.x);
        x1 = std::max(x1, n.x);
        y0 = std::min(y0, n.y);
        y1 = std::max(y1, n.y);
    }
    const double dx = x1 - x0 + 1, dy = y1 - y0 + 1;
    return step * std::sqrt(dx * dx + dy * dy);
}

/// Returns the directions in which lines may be laid: every 22.5 degrees, and the given ones.
std::vector<dvec2> ways_of(const std::vector<dvec2>& bridge_ways) {
    constexpr double c = 0.92387953251128674, s = 0.38268343236508977, d = 0.70710678118654752;
    std::vector<dvec2> ways{{1, 0}, {0, 1}, {d, d}, {-d, d}, {c, s}, {s, c}, {-s, c}, {-c, s}};
    constexpr std::size_t max_ways = 24;
    constexpr double same = 0.02;  // directions within this angle count as equal, radians
    for (const dvec2 way : bridge_ways) {
        if (ways.size() == max_ways) break;
        bool fresh = true;
        for (const dvec2 w : ways) fresh = fresh && std::abs(w.x * way.y - w.y * way.x) > same;
        if (fresh) ways.push_back(way);
    }
    return ways;
}

}  // namespace

void hold_spans(const PathQuestion& question, const SurveyedLayer& below,
                const std::vector<dvec2>& bridge_ways, SupportPlacer& placer) {
    const SurveyedLayer& layer = question.layer;
    RunRows over;
    const RunRows* hang = &layer.rows;
    if (below.rows.lines() > 0) {
        subtract(layer.rows, below.grown, over);
        hang = &over;
    }
    if (hang->runs().empty()) return;
    HangingLattice lattice(layer, *hang, question.by);
    if (lattice.empty()) return;
    const std::vector<dvec2> ways = ways_of(bridge_ways);
    for (int y = 0; y < lattice.lines(); ++y) {
        for (int x = 0; x < lattice.columns(); ++x) {
            if (lattice.at({x, y}) != hanging) continue;
            const std::vector<SpanNode> region = region_of(lattice, {x, y});
            bool excused = extent(region, lattice.step()) < question.limits.free_stretch;
            for (std::size_t w = 0; w < ways.size() && !excused; ++w) {
                excused = bridged(lattice, region, ways[w], question.limits.bridge);
            }
            for (const SpanNode n : region) {
                const dvec3 at(lattice.place(n), question.z);
                if (excused && (question.enforced == nullptr || !(question.enforced->value(at) < 0)))
                    continue;
                if (!placer.held(at)) placer.place(at, SupportReason::span);
            }
        }
    }
}

}  // namespace lamella
