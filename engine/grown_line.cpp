// Layer after layer, all runs of all lines in one loop.
#include "engine/grown_line.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lamella {

namespace {

double square(std::size_t count, double pitch) {
    const double distance = static_cast<double>(count) * pitch;
    return distance * distance;
}

}  // namespace

GrownLine::GrownLine(const LayerLattice& lattice, double most_weight, Run extent)
    : most_weight_(most_weight), union_(extent) {
    for (std::size_t k = 0; k == 0 || square(k, lattice.layer_pitch) <= most_weight; ++k) {
        // A single layer may be infinitely far from the next.
        Disc& disc = discs_.emplace_back(Disc{k == 0 ? 0 : square(k, lattice.layer_pitch), {}, {}});
        for (std::size_t l = 0;; ++l) {
            const double across = square(l, lattice.row_pitch), left = most_weight - across - disc.up;
            if (left < 0) break;
            disc.across.push_back(across);
            disc.reaches.emplace_back(std::sqrt(left));
        }
    }
}

void GrownLine::add(const BallRows& layer, std::size_t line, const Disc& disc) {
    const std::size_t beside = disc.across.size();
    if (beside == 0) return;
    const std::size_t first = line - std::min(line, beside - 1), end = std::min(line + beside, layer.lines());
    const auto middle = static_cast<std::int32_t>(line);
    const std::span<const BallRun> runs = layer.runs();
    const std::span<const std::int32_t> lines = layer.lines_of_runs();
    const RunUnion::Cells cells = union_.cells();
    const double most_weight = most_weight_;
    for (std::size_t i = layer.start(first), last = layer.start(end); i < last; ++i) {
        const BallRun& run = runs[i];
        const auto way = static_cast<std::size_t>(std::abs(lines[i] - middle));
        BallReach reach = disc.reaches[way];
        if (run.weight != most_weight) {
            const double left = run.weight - disc.across[way] - disc.up;
            if (left < 0) continue;
            reach = BallReach(std::sqrt(left));
        }
        cells.add(run.begin - reach.back, run.end + reach.ahead);
    }
}

void GrownLine::grow(std::span<const BallRows* const> layers, std::size_t layer, std::size_t line,
                     std::vector<Run>& out) {
    const std::size_t reach = discs_.size() - 1;
    for (std::size_t z = layer - std::min(layer, reach); z < std::min(layer + reach + 1, layers.size()); ++z)
        add(*layers[z], line, discs_[z < layer ? layer - z : z - layer]);
    union_.take(out);
}

}  // namespace lamella
