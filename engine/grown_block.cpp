// Covers, sees, forgets, halves.
#include "engine/grown_block.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

/// Far more than rounding makes of squares of lengths, run units^2.
constexpr double surely = 1;

/// Blocks of so few lines are no longer halved: what they could still forget costs less to grow.
constexpr std::int32_t lines_at_last = 4;

double square(double x) { return x * x; }

/// How far a line or layer lies from `count` of them, at least and at most.
struct Distances {
    double least, most;
    Distances(std::int32_t at, std::int32_t first, std::int32_t count, double pitch) {
        const double half = 0.5 * (count - 1), from_middle = std::abs(at - first - half);
        least = std::max(from_middle - half, 0.0) * pitch;
        most = (from_middle + half) * pitch;
    }
};

/// By how much the square of the distance from `a` is less than that from `b`, at least, in [first, last].
double nearer(double a, double b, double first, double last) {
    return (a - b) * (first + last - a - b) - std::abs(a - b) * (last - first);
}

}  // namespace

GrownBlock::GrownBlock(const LayerLattice& lattice, Run extent)
    : lattice_(lattice), levels_(1), union_(extent), table_(extent) {}

void GrownBlock::grow(const LineBlock& block, std::span<const BallRows* const> layers) {
    block_ = block;
    runs_.clear();
    places_.assign(place_of(block.layers, 0), {0, 0});
    gather(layers);
    refine(block, 0);
}

/// Takes all runs of lines that may reach the block.
void GrownBlock::gather(std::span<const BallRows* const> layers) {
    Level& all = levels_.front();
    all.lines.clear();
    all.covered.clear();
    for (std::size_t z = 0; z < layers.size(); ++z) {
        const auto layer = static_cast<std::int32_t>(z);
        const double left =
            layers[z]->most_weight() -
            square(Distances(layer, block_.layer, block_.layers, lattice_.layer_pitch).least) + surely;
        if (left < 0) continue;
        const auto reach = static_cast<std::int32_t>(lattice_.lines_within(std::sqrt(left)));
        const std::int32_t from = std::max(block_.line - reach, 0);
        const std::int32_t to =
            std::min(block_.line + block_.lines + reach, static_cast<std::int32_t>(lattice_.lines));
        for (std::int32_t line = from; line < to; ++line) {
            const std::span<const BallRun> runs = layers[z]->line(static_cast<std::size_t>(line));
            if (!runs.empty()) all.lines.push_back({layer, line, runs});
        }
    }
}

/// Level `depth` holds what the block above left.
void GrownBlock::refine(const LineBlock& block, std::size_t depth) {
    if (block.layers * block.lines <= lines_at_last) {
        finish_lines(block, levels_[depth]);
        return;
    }
    if (levels_.size() < depth + 2) levels_.resize(depth + 2);
    keep_visible(block, depth);
    if (levels_[depth + 1].lines.empty()) {
        place(block, levels_[depth + 1].covered);
        return;
    }
    const std::int32_t layers = (block.layers + 1) / 2, lines = (block.lines + 1) / 2;
    for (std::int32_t z = 0; z < block.layers; z += layers) {
        for (std::int32_t l = 0; l < block.lines; l += lines) {
            refine({block.layer + z, block.line + l, std::min(layers, block.layers - z),
                    std::min(lines, block.lines - l)},
                   depth + 1);
        }
    }
}

/// Finds what is covered on all lines of a block, and how far runs reach there.
void GrownBlock::cover(const LineBlock& block, const Level& above, std::vector<Run>& covered) {
    reaches_.clear();
    for (const Run& run : above.covered) union_.add(run.begin, run.end);
    std::int32_t layer = -1;
    double near_layer = 0, far_layer = 0;
    for (const SourceLine& source : above.lines) {
        if (source.layer != layer) {
            layer = source.layer;
            const Distances up(layer, block.layer, block.layers, lattice_.layer_pitch);
            near_layer = square(up.least) - surely;
            far_layer = square(up.most) + surely;
        }
        const Distances across(source.line, block.line, block.lines, lattice_.row_pitch);
        const double near = near_layer + square(across.least), far = far_layer + square(across.most);
        for (const BallRun& run : source.runs) {
            const double least = run.weight - far, most = run.weight - near;
            const Reaches reaches{least < 0 ? -1 : static_cast<std::int32_t>(std::sqrt(least)),
                                  most < 0 ? -1 : static_cast<std::int32_t>(std::sqrt(most)) + 1};
            if (least >= 0) union_.add(run.begin - reaches.least, run.end + reaches.least);
            reaches_.push_back(reaches);
        }
    }
    covered.clear();
    union_.take(covered);
}

/// Finds the runs that reach into gaps.
void GrownBlock::see(const Level& above, std::span<const Run> covered) {
    table_.assign(covered);
    visible_.clear();
    below_ = above_ = 0;
    champions_.assign(covered.size(), {{nullptr, nullptr}, {nullptr, nullptr}, far_out, -far_out});
    auto reaches = reaches_.begin();
    for (const SourceLine& line : above.lines) {
        for (const BallRun& run : line.runs) see({&line, &run}, *reaches++, covered);
    }
}

void GrownBlock::see(Source source, const Reaches& reaches, std::span<const Run> covered) {
    const BallRun& run = *source.run;
    if (reaches.most < 0) return;
    const Run most = table_.clip({run.begin - reaches.most, run.end + reaches.most});
    if (most.begin >= most.end) return;
    const std::size_t at = table_.first_run(most.begin);
    if (at == covered.size()) {
        visible_.push_back({source, most, nullptr});
        return;
    }
    const Run& meets = covered[at];
    const bool left = most.begin<meets.begin, right = most.end> meets.end;
    if (!left && !right) return;
    const bool within = (!left || run.begin >= meets.begin) && (!right || run.end <= meets.end);
    visible_.push_back({source, most, within ? &meets : nullptr});
    if (!within || reaches.least < 0) return;
    Champions& champions = champions_[at];
    const std::int32_t begin = 2 * run.begin - reaches.least - reaches.most;
    const std::int32_t end = 2 * run.end + reaches.least + reaches.most;
    if (left && begin < champions.least) {
        champions.least = begin;
        champions.left = source;
    }
    if (right && end > champions.greatest) {
        champions.greatest = end;
        champions.right = source;
    }
}

/// Whether others reach at least as far into gaps, on all lines of the block.
bool GrownBlock::is_outdone(const LineBlock& block, std::size_t k, std::span<const Run> covered) {
    const Visible& seen = visible_[k];
    bool left = true, right = true;
    if (seen.meets != nullptr) {
        const Champions& champions = champions_[static_cast<std::size_t>(seen.meets - covered.data())];
        left = seen.most.begin < seen.meets->begin && !outdoes(block, champions.left, seen, true, false);
        right = seen.most.end > seen.meets->end && !outdoes(block, champions.right, seen, false, true);
        if (!left && !right) return true;
    }
    const auto by = [&](std::size_t other) {
        return other < visible_.size() && visible_[other].meets == seen.meets &&
               outdoes(block, visible_[other].source, seen, left, right);
    };
    if (by(k - 1) || by(k + 1)) return true;
    below_ = find_beside(below_, seen.source, -1);
    if (by(below_)) return true;
    above_ = find_beside(above_, seen.source, 1);
    return by(above_);
}

/// The first that lies on the same line of another layer, or behind it.
std::size_t GrownBlock::find_beside(std::size_t from, const Source& source, std::int32_t up) const {
    const std::int32_t layer = source.line->layer + up, line = source.line->line;
    for (; from < visible_.size(); ++from) {
        const SourceLine& at = *visible_[from].source.line;
        if (at.layer > layer || (at.layer == layer && at.line >= line)) break;
    }
    return from;
}

/// Whether one run does.
bool GrownBlock::outdoes(const LineBlock& block, Source other, const Visible& seen, bool left,
                         bool right) const {
    if (other.run == nullptr) return false;
    const SourceLine& line = *seen.source.line;
    const BallRun &worse = *seen.source.run, &better = *other.run;
    const double gain = better.weight - worse.weight - surely +
                        nearer(other.line->layer, line.layer, block.layer, block.layer + block.layers - 1) *
                            square(lattice_.layer_pitch) +
                        nearer(other.line->line, line.line, block.line, block.line + block.lines - 1) *
                            square(lattice_.row_pitch);
    if (gain >= 0 && better.begin <= worse.begin && better.end >= worse.end) return true;
    if (seen.meets == nullptr) return false;
    return (!left || gain + nearer(better.begin, worse.begin, seen.most.begin, seen.meets->begin) >= 0) &&
           (!right || gain + nearer(better.end, worse.end, seen.meets->end, seen.most.end) >= 0);
}

/// Forgets runs that give no line of the block anything that others do not.
void GrownBlock::keep_visible(const LineBlock& block, std::size_t depth) {
    const Level& above = levels_[depth];
    Level& level = levels_[depth + 1];
    cover(block, above, level.covered);
    see(above, level.covered);
    level.lines.clear();
    level.runs.clear();
    level.runs.reserve(visible_.size());  // lines point into it
    const SourceLine* last = nullptr;
    for (std::size_t k = 0; k < visible_.size(); ++k) {
        if (is_outdone(block, k, level.covered)) continue;
        const Source& source = visible_[k].source;
        level.runs.push_back(*source.run);
        if (source.line == last) {
            std::span<const BallRun>& runs = level.lines.back().runs;
            runs = {runs.data(), runs.size() + 1};
        } else {
            level.lines.push_back({source.line->layer, source.line->line, {&level.runs.back(), 1}});
        }
        last = source.line;
    }
}

void GrownBlock::finish_lines(const LineBlock& block, const Level& level) {
    for (std::int32_t z = 0; z < block.layers; ++z) {
        for (std::int32_t l = 0; l < block.lines; ++l) finish_line(block.layer + z, block.line + l, level);
    }
}

void GrownBlock::finish_line(std::int32_t layer, std::int32_t line, const Level& level) {
    const RunUnion::Cells cells = union_.cells();
    for (const Run& run : level.covered) cells.add(run.begin, run.end);
    for (const SourceLine& source : level.lines) {
        const double across = (line - source.line) * lattice_.row_pitch;
        const double up = (layer - source.layer) * lattice_.layer_pitch;
        for (const BallRun& run : source.runs) {
            const double left = run.weight - across * across - up * up;
            if (left < 0) continue;
            const BallReach reach(std::sqrt(left));
            cells.add(run.begin - reach.back, run.end + reach.ahead);
        }
    }
    const std::size_t from = runs_.size();
    union_.take(runs_);
    places_[place_of(layer - block_.layer, line - block_.line)] = {from, runs_.size() - from};
}

/// All lines of a block get the same runs.
void GrownBlock::place(const LineBlock& block, std::span<const Run> runs) {
    const Place here{runs_.size(), runs.size()};
    runs_.insert(runs_.end(), runs.begin(), runs.end());
    for (std::int32_t z = 0; z < block.layers; ++z) {
        for (std::int32_t l = 0; l < block.lines; ++l)
            places_[place_of(block.layer - block_.layer + z, block.line - block_.line + l)] = here;
    }
}

}  // namespace lamella
