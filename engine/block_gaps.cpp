// Gap by gap, then line by line.
#include "engine/block_gaps.h"

#include <cstdlib>
#include <limits>

namespace lamella {

BlockGaps::BlockGaps(const LayerLattice& lattice, const BallReaches& reaches, Run extent)
    : lattice_(lattice), ball_(reaches), extent_(extent), table_(extent), union_(extent) {}

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
        gap.farthest_left = gap.farthest_right = std::numeric_limits<std::int32_t>::min();
    }
}

void BlockGaps::add(const BallRun& run, std::int32_t layer, std::int32_t line, const Reaches& reaches) {
    if (reaches.most < 0) return;
    const Run most = table_.clip({run.begin - reaches.most, run.end + reaches.most});
    if (most.begin >= most.end) return;
    std::size_t gap = table_.first_run(most.begin);
    if (gap < covered_.size() && most.begin >= covered_[gap].begin) ++gap;
    for (; gap < gap_count_ && most.end > gaps_[gap].run.begin; ++gap)
        add(gaps_[gap], {run.begin, run.end, run.weight, layer, line, reaches.most}, reaches);
}

void BlockGaps::add(Gap& gap, const GapSource& source, const Reaches& reaches) {
    const auto add_beside = [&](std::vector<GapSource>& beside, std::int32_t end, std::int32_t& farthest) {
        beside.push_back(source);
        if (reaches.least < 0 || std::abs(end) >= far_out) return;
        const std::int32_t about = 2 * end + reaches.least + reaches.most;
        if (about <= farthest) return;
        farthest = about;
        std::swap(beside.back(), beside.front());
    };
    if (source.begin <= gap.run.begin) {
        add_beside(gap.left, source.end, gap.farthest_left);
    } else if (source.end >= gap.run.end) {
        add_beside(gap.right, -source.begin, gap.farthest_right);
    } else {
        gap.within.push_back(source);
    }
}

void BlockGaps::grow() {
    for (std::vector<Run>& islands : islands_) islands.clear();
    for (std::size_t g = 0; g < gap_count_; ++g) {
        Gap& gap = gaps_[g];
        gap.limits.begin(block_, gap.run);
        gap.limits.grow_left(lattice_, ball_, block_, gap.left);
        gap.limits.grow_right(lattice_, ball_, block_, gap.right);
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
