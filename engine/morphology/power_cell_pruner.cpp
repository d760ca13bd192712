// PowerCellPruner: walks along two adjacent lines from left to right.
#include "engine/morphology/power_cell_pruner.h"

#include <cmath>

namespace lamella {
namespace {

/// Returns true if `run`, on an adjacent line, bounds the power cell of `other`: it reaches over the middle
/// of `other`, and its ball is at least as large.
bool limits(const WeightedRun& run, const WeightedRun& other) {
    const std::int32_t middle = (other.begin + other.end) >> 1;
    return static_cast<bool>(static_cast<int>(run.weight >= other.weight) &
                             static_cast<int>(run.begin <= middle) & static_cast<int>(middle <= run.end));
}

}  // namespace

PowerCellPruner::EndSight::EndSight(double pitch, double max_weight) : lines_(1, 0) {
    constexpr double rounding_margin = 1;  // run units^2; far more than the rounding error
    for (int lines = 1; lines < PowerCellBounds::unlimited; ++lines) {
        const double away = lines * pitch, left = max_weight + rounding_margin - away * away;
        if (left < 0) break;
        const double nearer = (2 * lines - 1) * pitch * pitch - rounding_margin;
        if (nearer < 0) continue;
        // An end that lies `back` behind, but a line nearer, reaches as far: from this line on it hides the
        // other.
        const double back = std::sqrt(left + nearer) - std::sqrt(left);
        const auto entries = static_cast<std::size_t>(back / step) + 1;
        if (entries > lines_.size()) lines_.resize(entries, static_cast<std::uint8_t>(lines - 1));
    }
    lines_.push_back(PowerCellBounds::unlimited);
    last_ = static_cast<std::uint32_t>(lines_.size()) - 1;
}

struct PowerCellPruner::Pair {
    std::span<const WeightedRun> runs;
    std::span<PowerCellBounds> sights;
    Neighbor other_side;  // side on which the other line lies
    std::span<const WeightedRun> other_runs;
    std::span<PowerCellBounds> other_sights;
    Neighbor side;
};

PowerCellPruner::PowerCellPruner(const LayerLattice& lattice, double max_weight)
    : across_(lattice.row_pitch, max_weight), up_(lattice.layer_pitch, max_weight) {}

void PowerCellPruner::limit(WeightedRows& layer) const {
    for (std::size_t l = 1; l < layer.lines(); ++l) {
        limit({layer.line(l - 1), layer.sights(l - 1), Neighbor::line_behind, layer.line(l), layer.sights(l),
               Neighbor::line_before},
              across_);
    }
}

void PowerCellPruner::limit(WeightedRows& below, WeightedRows& above, std::size_t first,
                            std::size_t end) const {
    for (std::size_t l = first; l < end; ++l) {
        limit({below.line(l), below.sights(l), Neighbor::layer_above, above.line(l), above.sights(l),
               Neighbor::layer_below},
              up_);
    }
}

void PowerCellPruner::limit(const Pair& pair, const EndSight& sight) {
    const WeightedRun *p = pair.runs.data(), *q = pair.other_runs.data();
    PowerCellBounds *of_p = pair.sights.data(), *of_q = pair.other_sights.data();
    const WeightedRun *const end_p = p + pair.runs.size(), *const end_q = q + pair.other_runs.size();
    while (p != end_p && q != end_q) {
        if (limits(*q, *p))
            of_p->limit(pair.other_side, sight.lines(q->begin - p->begin), sight.lines(p->end - q->end));
        if (limits(*p, *q))
            of_q->limit(pair.side, sight.lines(p->begin - q->begin), sight.lines(q->end - p->end));
        const std::ptrdiff_t p_first = p->end < q->end;
        p += p_first;
        of_p += p_first;
        q += 1 - p_first;
        of_q += 1 - p_first;
    }
}

}  // namespace lamella
