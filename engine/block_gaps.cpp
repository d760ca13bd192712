// Gap by gap, then line by line.
#include "engine/block_gaps.h"

#include <cstdlib>
#include <limits>

namespace lamella {

BlockGaps::BlockGaps(const LayerLattice& lattice, const BallReaches& reaches, Run extent)
    : lattice_(lattice), ball_(reaches), extent_(extent), table_(extent), union_(extent) {}

void BlockGaps::Beside::clear() {
    sources.clear();
    farthest = 0;
    reached = std::numeric_limits<std::int32_t>::min();
}

std::span<const GapSource> BlockGaps::Beside::sorted() {
    if (farthest > 0) std::swap(sources[farthest], sources.front());
    farthest = 0;
    return sources;
}

void BlockGaps::begin(const LineBlock& block, std::span<const Run> covered) {
    block_ = block;
    covered_.assign(covered.begin(), covered.end());
    table_.assign(covered);
    gap_count_ = covered.size() + 1;
    if (gaps_.size() < gap_count_) gaps_.resize(gap_count_);
    std::int32_t from = extent_.begin;
    for (std::size_t g = 0; g < gap_count_; ++g) {
        Gap& gap = gaps_[g];
        gap.run = {from, g < covered.size() ? covered[g].begin : extent_.end};
        if (g < covered.size()) from = covered[g].end;
        gap.left.clear();
        gap.right.clear();
        gap.within.clear();
    }
}

void BlockGaps::add(const BallRun& run, std::int32_t layer, std::int32_t line, const Reaches& reaches) {
    if (reaches.most < 0) return;
    const Run most = table_.clip({run.begin - reaches.most, run.end + reaches.most});
    if (most.begin >= most.end) return;
    std::size_t gap = table_.first_run(most.begin);
    if (gap < covered_.size() && most.begin >= covered_[gap].begin) ++gap;
    const auto append = [&](std::vector<GapSource>& to) {
        // Part by part: a whole that was just put together would have to be waited for.
        GapSource& source = to.emplace_back();
        source.begin = run.begin;
        source.end = run.end;
        source.weight = run.weight;
        source.layer = layer;
        source.line = line;
        source.most = reaches.most;
    };
    const auto append_beside = [&](Beside& beside, std::int32_t end) {
        append(beside.sources);
        const std::int32_t about = 2 * end + reaches.least + reaches.most;
        if (about <= beside.reached || reaches.least < 0 || std::abs(end) >= far_out) return;
        beside.reached = about;
        beside.farthest = beside.sources.size() - 1;
    };
    for (; gap < gap_count_ && most.end > gaps_[gap].run.begin; ++gap) {
        Gap& into = gaps_[gap];
        if (run.begin <= into.run.begin) {
            append_beside(into.left, run.end);
        } else if (run.end >= into.run.end) {
            append_beside(into.right, -run.begin);
        } else {
            append(into.within);
        }
    }
}

void BlockGaps::grow() {
    for (std::vector<Run>& islands : islands_) islands.clear();
    for (std::size_t g = 0; g < gap_count_; ++g) {
        Gap& gap = gaps_[g];
        gap.limits.begin(block_, gap.run);
        gap.limits.grow_left(lattice_, ball_, block_, gap.left.sorted());
        gap.limits.grow_right(lattice_, ball_, block_, gap.right.sorted());
        gap.limits.grow_within(lattice_, ball_, block_, gap.within, islands_);
    }
}

void BlockGaps::append_line(std::int32_t layer, std::int32_t line, std::vector<Run>& out) {
    const std::size_t first = out.size();
    Run grown{extent_.begin, extent_.begin};
    for (std::size_t g = 0; g < gap_count_; ++g) {
        const Run left = gaps_[g].limits.at(layer, line);
        if (left.begin < left.end) {
            grown.end = left.begin;
            if (grown.begin < grown.end) out.push_back(grown);
            grown.begin = left.end;
        }
        grown.end = g < covered_.size() ? covered_[g].end : extent_.end;
    }
    if (grown.begin < grown.end) out.push_back(grown);
    const std::vector<Run>& islands = islands_[GapLimits::place(layer, line)];
    if (islands.empty()) return;
    const RunUnion::Cells cells = union_.cells();
    for (std::size_t i = first; i < out.size(); ++i) cells.add(out[i].begin, out[i].end);
    for (const Run& run : islands) cells.add(run.begin, run.end);
    out.resize(first);
    union_.take(out);
}

}  // namespace lamella
