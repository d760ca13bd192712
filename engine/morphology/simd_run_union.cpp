// SimdRunUnion, compiled for every SIMD target. It uses integers and correctly rounded square roots, so every
// target gives the same bits.
#include "engine/morphology/simd_run_union.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

using std::isnan;  // of libhwy where there are no vectors, which expects that of <math.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/morphology/simd_run_union.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/highway.h>

#ifndef LAMELLA_BLOCK_UNION
#define LAMELLA_BLOCK_UNION
namespace lamella {

/// The (negated) begins and the ends in cells without a run: less than those of any run.
constexpr std::int32_t no_end = -unbounded;

/// The extents of a run on the lines of a block.
struct LineReaches {
    const std::int32_t *back, *ahead;  // those of the block's first line
    std::size_t stride;                // from layer to layer
};

/// Looks up the extents of the runs of one source layer.
class RunReaches {
  public:
    RunReaches(const LayerLattice& lattice, const BallExtentTable& table, const LineBlock& block)
        : lattice_(lattice), table_(table), block_(block), weight_(table.weight()), stride_(table.stride()) {}

    void turn_to(std::int32_t layer) {
        up_ = block_.layer - layer;
        table_back_ = table_.back(up_, 0);
        table_ahead_ = table_.ahead(up_, 0);
    }
    /// Returns how many lines a line lies before the block.
    std::int32_t lines_before(std::int32_t line) const { return block_.line - line; }
    /// Clamps a number of lines to the table; balls do not reach farther.
    std::int32_t in_table(std::int32_t lines) const { return table_.clamped_lines(lines); }
    bool are_in_table(double weight) const { return weight == weight_; }
    /// Returns the extents of a ball of the table, `lines` lines before the block; `lines` is clamped.
    LineReaches of_table(std::int32_t lines) const {
        return {table_back_ + lines, table_ahead_ + lines, stride_};
    }
    double row_pitch() const { return lattice_.row_pitch; }
    /// Returns the squared distance to a layer of the block, run units^2.
    double up_square(std::size_t layer) const {
        const std::int32_t layers = up_ + static_cast<std::int32_t>(layer);
        if (layers == 0) return 0;  // the pitch may be infinite
        return layers * lattice_.layer_pitch * (layers * lattice_.layer_pitch);
    }

  private:
    LayerLattice lattice_;
    const BallExtentTable& table_;
    LineBlock block_;
    double weight_;
    std::size_t stride_;
    std::int32_t up_ = 0;
    const std::int32_t *table_back_ = nullptr, *table_ahead_ = nullptr;
};

/// Adds a run that ends in the cell in which it begins. Goes line by line, because on some lines its dilation
/// reaches beyond the cell's end and on others it does not.
[[gnu::noinline]] inline void add_short(const Run& run, std::size_t cell, const LineReaches& reaches,
                                        SimdRunUnion::Cells& to) {
    for (std::size_t z = 0; z < to.layers; ++z) {
        SimdRunUnion::Covered& covered = to.layers_of(cell)[z];
        for (std::size_t l = 0; l < SimdRunUnion::edge; ++l) {
            const std::size_t at = z * reaches.stride + l;
            if (reaches.ahead[at] == BallExtentTable::none) continue;
            const Run grown{run.begin - reaches.back[at], run.end + reaches.ahead[at]};
            if (grown.end < to.end_of(cell)) {
                to.short_runs[z * SimdRunUnion::edge + l].push_back(grown);
            } else {
                to.used[cell] = SimdRunUnion::Use::some;
                covered.begins[l] = std::max(covered.begins[l], -grown.begin);
                covered.ends[l] = std::max(covered.ends[l], grown.end);
            }
        }
    }
}

}  // namespace lamella
#endif

HWY_BEFORE_NAMESPACE();
namespace lamella {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lines = hn::CappedTag<std::int32_t, SimdRunUnion::edge>;

HWY_INLINE void keep_greatest(Lines d, hn::Vec<Lines> value, std::int32_t* at) {
    hn::Store(hn::Max(hn::Load(d, at), value), d, at);
}

/// Calculates the extents of balls whose radius is not that of the table.
template <std::size_t layers>
class OtherBalls {
  public:
    LineReaches bounds(double weight, std::int32_t lines, const RunReaches& of_layer) {
        for (std::size_t z = 0; z < layers; ++z) {
            const double left = weight - of_layer.up_square(z);
            for (std::size_t l = 0; l < SimdRunUnion::edge; l += hn::Lanes(Reals())) {
                const std::size_t at = z * SimdRunUnion::edge + l;
                if (left < 0) {
                    hn::StoreU(hn::Set(Wholes(), BallExtentTable::none), Wholes(), back_.data() + at);
                    hn::StoreU(hn::Set(Wholes(), BallExtentTable::none), Wholes(), ahead_.data() + at);
                } else {
                    calculate(weight, lines + static_cast<double>(l), of_layer.row_pitch(),
                              of_layer.up_square(z), at);
                }
            }
        }
        return {back_.data(), ahead_.data(), SimdRunUnion::edge};
    }

  private:
    using Reals = hn::CappedTag<double, SimdRunUnion::edge>;
    using Wholes = hn::Rebind<std::int32_t, Reals>;

    void calculate(double weight, double lines, double row_pitch, double up_square, std::size_t at) {
        const Reals d;
        const Wholes whole;
        const auto across = hn::Mul(hn::Iota(d, lines), hn::Set(d, row_pitch)), one = hn::Set(d, 1.0);
        const auto left =
            hn::Sub(hn::Sub(hn::Set(d, weight), hn::Mul(across, across)), hn::Set(d, up_square));
        const auto reach = hn::Sqrt(hn::Max(left, hn::Zero(d)));
        // Rounds as RoundedExtent does.
        const auto ahead = hn::ShiftRight<1>(hn::DemoteTo(whole, hn::Add(hn::Add(reach, reach), one)));
        const auto tie = hn::Eq(hn::Sub(hn::PromoteTo(d, ahead), reach), hn::Set(d, 0.5));
        const auto back = hn::Sub(ahead, hn::DemoteTo(whole, hn::IfThenElseZero(tie, one)));
        const auto beyond = hn::DemoteTo(whole, hn::IfThenElseZero(hn::Lt(left, hn::Zero(d)), one));
        const auto within = hn::Eq(beyond, hn::Zero(whole));
        const auto none = hn::Set(whole, BallExtentTable::none);
        hn::StoreU(hn::IfThenElse(within, back, none), whole, back_.data() + at);
        hn::StoreU(hn::IfThenElse(within, ahead, none), whole, ahead_.data() + at);
    }

    std::array<std::int32_t, layers * SimdRunUnion::edge> back_, ahead_;
};

/// Adds runs to the cells, on all lines of `layers` layers.
template <std::size_t layers>
class RunAdder {
  public:
    explicit RunAdder(SimdRunUnion::Cells& to)
        : to_(to), extent_(to.extent), covered_(to.covered.data()), used_(to.used.data()) {}

    /// Adds a run that lies `lines` lines before the block; `in_table` is that number clamped to the table.
    HWY_INLINE void add(const WeightedRun& run, std::int32_t lines, std::int32_t in_table,
                        const RunReaches& of_layer) {
        const bool known = of_layer.are_in_table(run.weight);
        add(run, known ? of_layer.of_table(in_table) : others_.bounds(run.weight, lines, of_layer));
    }

  private:
    HWY_INLINE void add(const WeightedRun& run, const LineReaches& reaches) const {
        const Lines d;
        const Run clipped{std::max(run.begin, extent_.begin), std::min(run.end, extent_.end)};
        const std::size_t cell = static_cast<std::uint32_t>(clipped.begin - extent_.begin) / run_unit;
        if (clipped.end < extent_.begin + static_cast<std::int32_t>(cell + 1) * run_unit)
            return add_short(clipped, cell, reaches, to_);
        used_[cell] = SimdRunUnion::Use::some;
        const auto begin = hn::Set(d, -clipped.begin), end = hn::Set(d, clipped.end);
        SimdRunUnion::Covered* const covered = covered_ + cell * layers;
        for (std::size_t z = 0; z < layers; ++z) {
            for (std::size_t l = 0; l < SimdRunUnion::edge; l += hn::Lanes(d)) {
                const std::size_t at = z * reaches.stride + l;
                keep_greatest(d, hn::Add(begin, hn::LoadU(d, reaches.back + at)),
                              covered[z].begins.data() + l);
                keep_greatest(d, hn::Add(end, hn::LoadU(d, reaches.ahead + at)), covered[z].ends.data() + l);
            }
        }
    }

    SimdRunUnion::Cells& to_;
    Run extent_;
    SimdRunUnion::Covered* covered_;
    SimdRunUnion::Use* used_;
    OtherBalls<layers> others_;
};

template <std::size_t layers>
void add_rows_of(std::span<const WeightedRun> runs, const std::int32_t* lines, std::int32_t line,
                 RunReaches& reaches, SimdRunUnion::Cells& to) {
    RunAdder<layers> adder(to);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const std::int32_t before = line - lines[i];
        adder.add(runs[i], before, before, reaches);
    }
}

template <std::size_t layers>
void add_lines_of(std::span<const SourceLine> lines, RunReaches& reaches, SimdRunUnion::Cells& to) {
    RunAdder<layers> adder(to);
    for (const SourceLine& line : lines) {
        reaches.turn_to(line.layer);
        const std::int32_t before = reaches.lines_before(line.line), in_table = reaches.in_table(before);
        for (const WeightedRun& run : line.runs) adder.add(run, before, in_table, reaches);
    }
}

void add_rows(std::span<const WeightedRun> runs, const std::int32_t* lines, std::int32_t line,
              RunReaches& reaches, SimdRunUnion::Cells& to) {
    if (to.layers == 1) return add_rows_of<1>(runs, lines, line, reaches, to);
    if (to.layers == 2) return add_rows_of<2>(runs, lines, line, reaches, to);
    if (to.layers == 4) return add_rows_of<4>(runs, lines, line, reaches, to);
    add_rows_of<8>(runs, lines, line, reaches, to);
}

void add_lines(std::span<const SourceLine> lines, RunReaches& reaches, SimdRunUnion::Cells& to) {
    if (to.layers == 1) return add_lines_of<1>(lines, reaches, to);
    if (to.layers == 2) return add_lines_of<2>(lines, reaches, to);
    if (to.layers == 4) return add_lines_of<4>(lines, reaches, to);
    add_lines_of<8>(lines, reaches, to);
}

/// Appends the runs of the union to `out` and clears the cells.
void take_runs(std::span<const std::uint32_t> used, SimdRunUnion::Cells& cells, SimdRunUnion::Lines& out) {
    const Lines d;
    const auto zero = hn::Zero(d), none = hn::Set(d, no_end);
    HWY_ALIGN std::int32_t run_begins[SimdRunUnion::edge], run_ends[SimdRunUnion::edge];
    for (std::size_t z = 0; z < cells.layers; ++z) {
        for (std::size_t l = 0; l < SimdRunUnion::edge; l += hn::Lanes(d)) {
            std::vector<Run>* const lines = out.data() + z * SimdRunUnion::edge + l;
            const auto push = [&](hn::Vec<Lines> begins, hn::Vec<Lines> ends) {
                hn::Store(begins, d, run_begins);
                hn::Store(ends, d, run_ends);
                for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
                    const Run run{std::max(-run_begins[i], cells.extent.begin),
                                  std::min(run_ends[i], cells.extent.end)};
                    if (run.begin < run.end) lines[i].push_back(run);
                }
            };
            // Replaces each cell's begin by the least begin of this cell and all later ones.
            auto begins = none;
            for (std::size_t k = used.size(); k-- > 0;) {
                std::int32_t* const at = cells.layers_of(used[k])[z].begins.data() + l;
                begins = hn::Max(begins, hn::Load(d, at));
                hn::Store(begins, d, at);
            }
            auto ends = none;
            begins = none;
            for (const std::uint32_t cell : used) {
                SimdRunUnion::Covered& covered = cells.layers_of(cell)[z];
                std::int32_t* const begins_at = covered.begins.data() + l;
                std::int32_t* const ends_at = covered.ends.data() + l;
                const auto b = hn::Load(d, begins_at), e = hn::Load(d, ends_at);
                hn::Store(none, d, begins_at);
                hn::Store(none, d, ends_at);
                const auto behind_gap = hn::And(hn::Lt(hn::Add(ends, b), zero), hn::Lt(ends, e));
                if (!hn::AllFalse(d, behind_gap)) {
                    push(begins, hn::IfThenElse(behind_gap, ends, none));
                    begins = hn::IfThenElse(behind_gap, b, begins);
                }
                ends = hn::Max(ends, e);
            }
            push(begins, ends);
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace lamella
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lamella {

HWY_EXPORT(add_rows);
HWY_EXPORT(add_lines);
HWY_EXPORT(take_runs);

SimdRunUnion::SimdRunUnion(const LayerLattice& lattice, const BallExtentTable& reaches, Run extent,
                           std::int32_t max_layers)
    : lattice_(lattice),
      reaches_(reaches),
      cells_{extent, std::bit_ceil(static_cast<std::size_t>(max_layers)), {}, {}, {}},
      with_short_(extent) {
    const std::size_t cells = cells_.cell_of(extent.end) + 1;
    Covered nothing;
    nothing.begins.fill(no_end);
    nothing.ends.fill(no_end);
    cells_.covered.assign(cells * cells_.layers, nothing);
    cells_.used.assign((cells / 8 + 1) * 8, Use::none);
}

void SimdRunUnion::add(const WeightedRows& rows, std::int32_t layer, std::size_t from, std::size_t to) {
    RunReaches reaches(lattice_, reaches_, block_);
    reaches.turn_to(layer);
    HWY_DYNAMIC_DISPATCH(add_rows)
    (rows.runs().subspan(from, to - from), rows.lines_of_runs().data() + from, block_.line, reaches, cells_);
}

void SimdRunUnion::add(std::span<const SourceLine> lines) {
    RunReaches reaches(lattice_, reaches_, block_);
    HWY_DYNAMIC_DISPATCH(add_lines)(lines, reaches, cells_);
}

void SimdRunUnion::add_covered(std::span<const Run> runs) {
    for (const Run& run : runs) {
        const std::size_t cell = cells_.cell_of(run.begin);
        if (run.end < cells_.end_of(cell)) {
            for (std::size_t i = 0; i < cells_.layers * edge; ++i) cells_.short_runs[i].push_back(run);
            continue;
        }
        cells_.used[cell] = Use::some;
        for (std::size_t z = 0; z < cells_.layers; ++z) {
            Covered& covered = cells_.layers_of(cell)[z];
            for (std::int32_t& begin : covered.begins) begin = std::max(begin, -run.begin);
            for (std::int32_t& end : covered.ends) end = std::max(end, run.end);
        }
    }
}

void SimdRunUnion::unite() {
    list_used();
    for (std::size_t i = 0; i < cells_.layers * edge; ++i) lines_[i].clear();
    HWY_DYNAMIC_DISPATCH(take_runs)(used_cells_, cells_, lines_);
    for (std::size_t i = 0; i < cells_.layers * edge; ++i) {
        std::vector<Run>& short_runs = cells_.short_runs[i];
        if (short_runs.empty()) continue;
        const RunUnion::Cells both = with_short_.cells();
        for (const Run& run : lines_[i]) both.add(run.begin, run.end);
        for (const Run& run : short_runs) both.add(run.begin, run.end);
        short_runs.clear();
        lines_[i].clear();
        with_short_.take(lines_[i]);
    }
}

void SimdRunUnion::list_used() {
    used_cells_.clear();
    for (std::size_t c = 0; c < cells_.used.size(); c += 8) {
        std::uint64_t word;
        std::memcpy(&word, cells_.used.data() + c, 8);
        if (word == 0) continue;
        for (std::size_t i = c; i < c + 8; ++i) {
            if (cells_.used[i] == Use::some) used_cells_.push_back(static_cast<std::uint32_t>(i));
            cells_.used[i] = Use::none;
        }
    }
}

}  // namespace lamella
#endif
