// PrunedDilation: bounds what is covered, drops hidden runs, halves the block, recurses.
#include "engine/morphology/pruned_dilation.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

/// Far more than the rounding error of squared lengths, run units^2.
constexpr double rounding_bound = 1;

double square(double x) { return x * x; }

/// Returns the least value of (x - b)^2 - (x - a)^2 over x in [first, last]: by how much `a` is nearer than
/// `b`, in squared distance.
double nearer(std::int64_t a, std::int64_t b, std::int64_t first, std::int64_t last) {
    const std::int64_t farthest = a < b ? last : first;  // where b does best
    return static_cast<double>((a - b) * (2 * farthest - a - b));
}

}  // namespace

PrunedDilation::PrunedDilation(const LayerLattice& lattice, const BallExtentTable& reaches, Run extent,
                               std::int32_t max_layers, double max_weight)
    : lattice_(lattice),
      layer_square_(square(lattice.layer_pitch)),
      row_square_(square(lattice.row_pitch)),
      max_weight_(max_weight),
      ball_(reaches),
      levels_(1),
      union_(extent),
      table_(extent),
      small_(lattice, reaches, extent, std::min(max_layers, SimdRunUnion::edge)) {}

void PrunedDilation::grow(const LineBlock& block, std::span<const WeightedRows* const> layers) {
    block_ = block;
    runs_.clear();
    line_runs_.assign(line_index(block.layers, 0), {0, 0});
    list_farthest();
    cover_by_some(layers);
    table_.assign(covered_);
    gather(layers);
    if (levels_.front().lines.empty()) return place(block_, levels_.front().covered);
    refine(block_, 0);
}

/// Bounds from below what is covered in the block, from a sample of the lines around it. This rules out most
/// runs before they are gathered.
void PrunedDilation::cover_by_some(std::span<const WeightedRows* const> layers) {
    constexpr double share = 0.75;        // of the reach: lines farther away cover little
    constexpr double lines_in_reach = 5;  // number of sampled lines, or layers, in the reach
    const double reach = std::sqrt(max_weight_);
    const auto stride = [&](double pitch) {
        return std::max(static_cast<std::int32_t>(reach / pitch / lines_in_reach), 2);
    };
    const auto first = [&](std::int32_t of_block, double pitch) {
        return std::max(of_block - static_cast<std::int32_t>(share * reach / pitch), 0);
    };
    const auto end = [&](std::int32_t of_block, double pitch, std::size_t most) {
        return std::min(of_block + static_cast<std::int32_t>(share * reach / pitch),
                        static_cast<std::int32_t>(most));
    };
    const double up_pitch = lattice_.layer_pitch, across_pitch = lattice_.row_pitch;
    const std::int32_t first_line = first(block_.line, across_pitch),
                       end_line = end(block_.line + block_.lines, across_pitch, lattice_.lines),
                       end_layer = end(block_.layer + block_.layers, up_pitch, layers.size());
    BlockExtents reaches(lattice_, ball_, block_);
    for (std::int32_t z = first(block_.layer, up_pitch); z < end_layer; z += stride(up_pitch)) {
        for (std::int32_t l = first_line; l < end_line; l += stride(across_pitch)) {
            reaches.set_source_line(z, l);
            for (const WeightedRun& run :
                 layers[static_cast<std::size_t>(z)]->line(static_cast<std::size_t>(l))) {
                const std::int32_t least = reaches.bounds(run.weight).least;
                if (least >= 0) union_.add(run.begin - least, run.end + least);
            }
        }
    }
    covered_.clear();
    union_.take(covered_);
}

/// Gathers the runs of all lines within reach of the block. Skips those that only reach points known to be
/// covered, and those that are hidden by runs on adjacent lines.
void PrunedDilation::gather(std::span<const WeightedRows* const> layers) {
    Level& all = levels_.front();
    all.covered = covered_;
    all.lines.clear();
    all.runs.clear();
    for (std::size_t z = 0; z < layers.size(); ++z) gather_layer(static_cast<std::int32_t>(z), *layers[z]);
    // all.runs does not move any more: set the pointers into it.
    auto runs = all.runs.begin();
    for (SourceLine& line : all.lines) {
        line.runs = {runs, line.runs.size()};
        runs += static_cast<std::ptrdiff_t>(line.runs.size());
    }
}

void PrunedDilation::gather_layer(std::int32_t layer, const WeightedRows& rows) {
    const std::int32_t below = block_.layer - layer, above = layer - (block_.layer + block_.layers - 1);
    const auto away = static_cast<std::size_t>(std::max({below, above, 0}));
    if (away >= farthest_.size()) return;
    const std::vector<std::int32_t>& farthest = farthest_[away];
    const auto beside = (static_cast<std::int32_t>(farthest.size()) - block_.lines) / 2;
    const std::int32_t before = block_.line - beside;  // line of the list's first entry
    const auto first = static_cast<std::size_t>(std::max(before, 0)),
               end = std::min(static_cast<std::size_t>(block_.line + block_.lines + beside), lattice_.lines);
    const std::size_t from = rows.start(first), to = rows.start(end);
    uncovered_.resize(std::max(uncovered_.size(), to - from));
    const WeightedRun* const runs = rows.runs().data();
    const std::int32_t* const lines = rows.lines_of_runs().data();
    std::uint32_t* kept = uncovered_.data();
    for (std::size_t i = from; i < to; ++i) {
        const std::int32_t most = farthest[static_cast<std::size_t>(lines[i] - before)];
        *kept = static_cast<std::uint32_t>(i);
        kept += !table_.surely_covers(table_.clip({runs[i].begin - most, runs[i].end + most}));
    }
    if (!rows.sights().empty()) {
        const BlockOffset up =
            BlockOffset(Neighbor::layer_above, below) | BlockOffset(Neighbor::layer_below, above);
        const BlockOffset* const aside = aside_.data() + (aside_.size() - farthest.size()) / 2;
        const std::span<const std::uint32_t> uncovered(uncovered_.data(), kept);
        kept = uncovered_.data();
        for (const std::uint32_t i : uncovered) {
            *kept = i;
            kept += rows.sights()[i].reaches(aside[static_cast<std::size_t>(lines[i] - before)] | up);
        }
    }
    Level& all = levels_.front();
    for (const std::uint32_t* i = uncovered_.data(); i != kept; ++i) {
        if (all.lines.empty() || all.lines.back().line != lines[*i] || all.lines.back().layer != layer)
            all.lines.push_back({layer, lines[*i], {}});
        std::span<const WeightedRun>& of_line = all.lines.back().runs;
        of_line = {runs, of_line.size() + 1};  // only the count; gather() sets the pointer
        all.runs.push_back(runs[*i]);
    }
}

/// Lists the greatest extent of a run in the block, for each line around it.
void PrunedDilation::list_farthest() {
    if (block_.lines == farthest_lines_) return;
    farthest_lines_ = block_.lines;
    farthest_.clear();
    for (std::size_t layers = 0;; ++layers) {
        const double up = static_cast<double>(layers) * lattice_.layer_pitch;
        const double left = max_weight_ + rounding_bound - square(up);
        if (left < 0) break;
        const auto beside = static_cast<std::int32_t>(lattice_.lines_within(std::sqrt(left)));
        std::vector<std::int32_t>& farthest = farthest_.emplace_back();
        for (std::int32_t l = -beside; l < block_.lines + beside; ++l) {
            const double across = LinesAway(l, 0, block_.lines).least * lattice_.row_pitch;
            farthest.push_back(static_cast<std::int32_t>(std::sqrt(std::max(left - square(across), 0.0))) +
                               1);
        }
    }
    aside_.clear();
    const auto beside = (static_cast<std::int32_t>(farthest_.front().size()) - block_.lines) / 2;
    for (std::int32_t l = -beside; l < block_.lines + beside; ++l) {
        aside_.push_back(BlockOffset(Neighbor::line_behind, -l) |
                         BlockOffset(Neighbor::line_before, l - block_.lines + 1));
    }
}

/// Dilates a block from levels_[depth], the runs left by its parent block.
void PrunedDilation::refine(const LineBlock& block, std::size_t depth) {
    if (block.layers <= SimdRunUnion::edge && block.lines <= SimdRunUnion::edge) {
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

/// Bounds from below what is covered on every line of a block, and computes the extent bounds of the runs.
void PrunedDilation::cover(const LineBlock& block, const Level& above, std::vector<Run>& covered) {
    reaches_.clear();
    for (const Run& run : above.covered) union_.add(run.begin, run.end);
    BlockExtents of_block(lattice_, ball_, block);
    const RunUnion::Cells cells = union_.cells();
    for (const SourceLine& source : above.lines) {
        of_block.set_source_line(source.layer, source.line);
        for (const WeightedRun& run : source.runs) {
            const ExtentBounds reaches = of_block.bounds(run.weight);
            if (reaches.least >= 0) cells.add(run.begin - reaches.least, run.end + reaches.least);
            reaches_.push_back(reaches);
        }
    }
    covered.clear();
    union_.take(covered);
}

/// Finds the runs that may reach into gaps.
void PrunedDilation::add_visible(const Level& above, std::span<const Run> covered) {
    table_.assign(covered);
    visible_.clear();
    champions_.assign(covered.size(), {{nullptr, nullptr}, {nullptr, nullptr}, unbounded, -unbounded});
    auto reaches = reaches_.begin();
    for (const SourceLine& line : above.lines) {
        for (const WeightedRun& run : line.runs) add_visible({&line, &run}, *reaches++, covered);
    }
}

void PrunedDilation::add_visible(Source source, const ExtentBounds& reaches, std::span<const Run> covered) {
    const WeightedRun& run = *source.run;
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

/// Returns true if `other` reaches at least as far as `seen` does, on all lines of the block, into the gaps
/// left and right, as asked for. Inlined by force: that takes a fifth less time.
[[gnu::always_inline]] inline bool PrunedDilation::outdoes(const LineBlock& block, Source other,
                                                           const Visible& seen, bool left, bool right) const {
    if (other.run == nullptr) return false;
    const SourceLine& line = *seen.source.line;
    const WeightedRun &worse = *seen.source.run, &better = *other.run;
    double gain = better.weight - worse.weight - rounding_bound;
    if (other.line->layer != line.layer)
        gain += layer_square_ *
                nearer(other.line->layer, line.layer, block.layer, block.layer + block.layers - 1);
    if (other.line->line != line.line)
        gain += row_square_ * nearer(other.line->line, line.line, block.line, block.line + block.lines - 1);
    if (gain >= 0 && better.begin <= worse.begin && better.end >= worse.end) return true;
    if (seen.meets == nullptr) return false;
    return (!left || gain + nearer(better.begin, worse.begin, seen.most.begin, seen.meets->begin) >= 0) &&
           (!right || gain + nearer(better.end, worse.end, seen.meets->end, seen.most.end) >= 0);
}

/// Returns true if other runs reach at least as far into the gaps as visible run `k`, on all lines of the
/// block.
bool PrunedDilation::is_outdone(const LineBlock& block, std::size_t k, std::span<const Run> covered) const {
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
    return by(k - 1) || by(k + 1);
}

/// Fills the next level with the runs that may cover points of the block that no other run covers.
void PrunedDilation::keep_visible(const LineBlock& block, std::size_t depth) {
    const Level& above = levels_[depth];
    Level& level = levels_[depth + 1];
    cover(block, above, level.covered);
    add_visible(above, level.covered);
    level.lines.clear();
    level.runs.clear();
    level.runs.reserve(visible_.size());  // lines point into it
    const SourceLine* last = nullptr;
    for (std::size_t k = 0; k < visible_.size(); ++k) {
        if (is_outdone(block, k, level.covered)) continue;
        const Source& source = visible_[k].source;
        level.runs.push_back(*source.run);
        if (source.line == last) {
            std::span<const WeightedRun>& runs = level.lines.back().runs;
            runs = {runs.data(), runs.size() + 1};
        } else {
            level.lines.push_back({source.line->layer, source.line->line, {&level.runs.back(), 1}});
        }
        last = source.line;
    }
}

void PrunedDilation::finish_lines(const LineBlock& block, const Level& level) {
    small_.begin(block);
    small_.add_covered(level.covered);
    small_.add(level.lines);
    small_.unite();
    for (std::int32_t z = 0; z < block.layers; ++z) {
        for (std::int32_t l = 0; l < block.lines; ++l) {
            const std::span<const Run> runs = small_.line(z, l);
            line_runs_[line_index(block.layer - block_.layer + z, block.line - block_.line + l)] = {
                runs_.size(), runs.size()};
            runs_.insert(runs_.end(), runs.begin(), runs.end());
        }
    }
}

/// Gives all lines of a block the same runs.
void PrunedDilation::place(const LineBlock& block, std::span<const Run> runs) {
    const LineRuns here{runs_.size(), runs.size()};
    runs_.insert(runs_.end(), runs.begin(), runs.end());
    for (std::int32_t z = 0; z < block.layers; ++z) {
        for (std::int32_t l = 0; l < block.lines; ++l)
            line_runs_[line_index(block.layer - block_.layer + z, block.line - block_.line + l)] = here;
    }
}

}  // namespace lamella
