// RowBitmask: dilation of cells by a disc, several lines at once, from the centre line of the disc outward.
// With each line farther away, the bits collected so far are widened once more, so that those of the nearest
// line end up widest. Words whose result is known beforehand are skipped. Compiled for every SIMD target; all
// operations are on integers, so every target gives the same bits.
#include <algorithm>
#include <vector>

#include "engine/morphology/row_bitmask.h"
#include "engine/runs/bit_runs.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/morphology/row_bitmask_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/aligned_allocator.h>
#include <hwy/highway.h>

#ifndef LAMELLA_GROWN_CELLS_RESULT
#define LAMELLA_GROWN_CELLS_RESULT
namespace lamella {

/// What to do with the dilation: store it, store its complement, or subtract it.
enum class WithinDisc : std::uint8_t { kept, left_out, subtracted };

}  // namespace lamella
#endif

HWY_BEFORE_NAMESPACE();
namespace lamella {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lines = hn::CappedTag<std::uint64_t, CellLattice::lines_at_once>;

/// The words of a few lines (one per lane), in a range of columns.
class LineBlock {
  public:
    explicit LineBlock(std::size_t words)
        : block_(hwy::AllocateAligned<std::uint64_t>(words * hn::Lanes(Lines()))) {}

    /// Clears the words of columns [first, end).
    void begin(std::size_t first, std::size_t end) {
        first_ = first;
        words_ = end - first;
        std::fill_n(block_.get(), words_ * hn::Lanes(Lines()), 0);
    }
    /// Adds the cells of the lines from `here` on and from `there` on, then widens all by `by` cells.
    void add_and_widen(const RowBitmask& cells, std::ptrdiff_t here, std::ptrdiff_t there, std::int32_t by) {
        const auto sum = [&](std::size_t i) {
            const Lines d;
            const std::uint64_t* const words = cells.column(first_ + i);
            return hn::Or(hn::Load(d, at(i)),
                          hn::Or(hn::LoadU(d, words + here), hn::LoadU(d, words + there)));
        };
        if (by > 0) {
            add_moved(1, sum);
            widen(1, by);
        } else {
            for (std::size_t i = 0; i < words_; ++i) hn::Store(sum(i), Lines(), at(i));
        }
    }
    /// Continues a widening by `width` cells to one by `to` cells to either side.
    void widen(std::int32_t width, std::int32_t to) {
        while (width < to) {
            // The moved copies must not leave a gap between them.
            const std::int32_t step = std::min({to - width, width + 1, 63});
            add_moved(step, [&](std::size_t i) { return hn::Load(Lines(), at(i)); });
            width += step;
        }
    }
    /// Writes the words of columns [first, end) to the lines of `to` from `line` on.
    void write(std::size_t first, std::size_t end, std::ptrdiff_t line, WithinDisc within,
               RowBitmask& to) const {
        const Lines d;
        for (std::size_t i = first; i < end; ++i) {
            std::uint64_t* const words = to.column(i) + line;
            const auto grown = hn::Load(d, at(i - first_));
            if (within == WithinDisc::kept) hn::StoreU(grown, d, words);
            if (within == WithinDisc::left_out) hn::StoreU(hn::Not(grown), d, words);
            if (within == WithinDisc::subtracted)
                hn::StoreU(hn::AndNot(grown, hn::LoadU(d, words)), d, words);
        }
    }

  private:
    /// Stores the union of words(i) and its copies moved by `cells` (1 to 63) to either side.
    template <typename WordsAt>
    HWY_INLINE void add_moved(int cells, WordsAt words) {
        const Lines d;
        const int others = 64 - cells;
        auto before = hn::Zero(d), here = words(0);
        for (std::size_t i = 0; i < words_; ++i) {
            const auto behind = i + 1 < words_ ? words(i + 1) : hn::Zero(d);
            const auto up = hn::Or(hn::ShiftLeftSame(here, cells), hn::ShiftRightSame(before, others)),
                       down = hn::Or(hn::ShiftRightSame(here, cells), hn::ShiftLeftSame(behind, others));
            hn::Store(hn::Or(here, hn::Or(up, down)), d, at(i));
            before = here;
            here = behind;
        }
    }
    std::uint64_t* at(std::size_t i) const { return block_.get() + i * hn::Lanes(Lines()); }

    std::size_t first_ = 0, words_ = 0;
    hwy::AlignedFreeUniquePtr<std::uint64_t[]> block_;
};

/// Sets of columns, at most 64 bits: a bit per column, or per group of columns.
class ColumnSets {
  public:
    explicit ColumnSets(std::size_t words) : words_(words), group_((words + 63) / 64) {}

    /// Returns the groups with a column for which is(words) holds; `words` are those of a few lines.
    template <typename Is>
    HWY_INLINE std::uint64_t where(const RowBitmask& cells, std::ptrdiff_t line, Is is) const {
        std::uint64_t set = 0, bit = 1;
        for (std::size_t first = 0; first < words_; first += group_, bit <<= 1) {
            for (std::size_t i = first; i < std::min(first + group_, words_); ++i) {
                if (is(hn::LoadU(Lines(), cells.column(i) + line))) set |= bit;
            }
        }
        return set;
    }
    std::uint64_t any(const RowBitmask& cells, std::ptrdiff_t line) const {
        return where(cells, line, [](auto words) HWY_ATTR {
            return !hn::AllTrue(Lines(), hn::Eq(words, hn::Zero(Lines())));
        });
    }
    std::uint64_t not_all(const RowBitmask& cells, std::ptrdiff_t line) const {
        return where(cells, line, [](auto words) HWY_ATTR {
            return !hn::AllTrue(Lines(), hn::Eq(words, hn::Not(hn::Zero(Lines()))));
        });
    }
    /// Adds the groups that have a column within `columns` of a column of the set.
    std::uint64_t widened(std::uint64_t set, std::size_t columns) const {
        for (std::size_t i = 0; i < columns && i < 64; i += group_) set |= set << 1 | set >> 1;
        return set;
    }
    /// Calls visit(first, end) for each run of columns of a set.
    template <typename Visit>
    void for_runs(std::uint64_t set, Visit visit) const {
        for_bit_runs(set, [&](int first, int end) {
            const std::size_t column = static_cast<std::size_t>(first) * group_;
            if (column < words_) visit(column, std::min(static_cast<std::size_t>(end) * group_, words_));
        });
    }

  private:
    std::size_t words_, group_;
};

void subtract(const RowBitmask& cells, std::size_t words, std::ptrdiff_t line, RowBitmask& from) {
    const Lines d;
    for (std::size_t i = 0; i < words; ++i) {
        std::uint64_t* const left = from.column(i) + line;
        hn::StoreU(hn::AndNot(hn::LoadU(d, cells.column(i) + line), hn::LoadU(d, left)), d, left);
    }
}

/// Dilation of a few lines, in a range of columns.
class LineGrowth {
  public:
    LineGrowth(const RowBitmask& cells, const DiscWidths& disc, WithinDisc within)
        : cells_(cells), disc_(disc), within_(within), block_(cells.lattice().words) {}

    /// How many lines and columns to either side the disc reaches.
    std::ptrdiff_t lines() const { return static_cast<std::ptrdiff_t>(disc_.size()) - 1; }
    std::size_t columns() const {
        return disc_.empty() ? 0 : static_cast<std::size_t>(disc_.front() + 63) / 64;
    }

    void grow(std::ptrdiff_t line, std::size_t first, std::size_t end, RowBitmask& to) {
        const CellLattice& lattice = cells_.lattice();
        const auto all_lines = static_cast<std::ptrdiff_t>(lattice.lines),
                   at_once = static_cast<std::ptrdiff_t>(hn::Lanes(Lines()));
        block_.begin(first - std::min(first, columns()), std::min(end + columns(), lattice.words));
        for (std::ptrdiff_t k = 0; k <= lines(); ++k) {
            const auto at = static_cast<std::size_t>(k);
            const std::int32_t by = disc_[at] - (k < lines() ? disc_[at + 1] : 0);
            // Outside the lattice there are no cells.
            const std::ptrdiff_t before = line - k, behind = line + k;
            const bool any_before = before + at_once > 0, any_behind = behind < all_lines;
            if (any_before || any_behind) {
                block_.add_and_widen(cells_, any_before ? before : behind, any_behind ? behind : before, by);
            } else {
                block_.widen(0, by);
            }
        }
        block_.write(first, end, line, within_, to);
    }

  private:
    const RowBitmask& cells_;
    const DiscWidths& disc_;
    WithinDisc within_;
    LineBlock block_;
};

void grow_cells(const RowBitmask& cells, const DiscWidths& disc, WithinDisc within, RowBitmask& to) {
    const CellLattice& lattice = cells.lattice();
    const ColumnSets sets(lattice.words);
    LineGrowth growth(cells, disc, within);
    const auto at_once = static_cast<std::ptrdiff_t>(hn::Lanes(Lines())),
               blocks = static_cast<std::ptrdiff_t>(lattice.lines) / at_once,
               reach = (growth.lines() + at_once - 1) / at_once;
    std::vector<std::uint64_t> occupied;
    for (std::ptrdiff_t b = 0; b < blocks; ++b) occupied.push_back(sets.any(cells, b * at_once));
    for (std::ptrdiff_t b = 0; b < blocks; ++b) {
        const std::ptrdiff_t line = b * at_once;
        std::uint64_t near = 0;
        for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(b - reach, 0); k <= std::min(b + reach, blocks - 1);
             ++k)
            near |= occupied[static_cast<std::size_t>(k)];
        near = sets.widened(near, growth.columns());
        std::uint64_t open = near;  // where the result is not known yet
        if (within == WithinDisc::left_out) {
            // Far from all cells the result is full; where all words are full it is empty.
            sets.for_runs(~near, [&](std::size_t first, std::size_t end) {
                for (std::size_t i = first; i < end; ++i)
                    std::fill_n(to.column(i) + line, at_once, ~std::uint64_t{0});
            });
            open &= sets.not_all(cells, line);
        } else if (within == WithinDisc::subtracted) {
            subtract(cells, lattice.words, line, to);
            open &= sets.any(to, line);
        }
        sets.for_runs(open, [&](std::size_t first, std::size_t end) { growth.grow(line, first, end, to); });
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace lamella
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lamella {

HWY_EXPORT(grow_cells);

RowBitmask RowBitmask::grown(const DiscWidths& disc) const {
    RowBitmask all(lattice_);
    HWY_DYNAMIC_DISPATCH(grow_cells)(*this, disc, WithinDisc::kept, all);
    return all;
}

RowBitmask RowBitmask::beyond(const DiscWidths& disc) const {
    RowBitmask others(lattice_);
    HWY_DYNAMIC_DISPATCH(grow_cells)(*this, disc, WithinDisc::left_out, others);
    return others;
}

void RowBitmask::subtract_dilated(const RowBitmask& other, const DiscWidths& disc) {
    HWY_DYNAMIC_DISPATCH(grow_cells)(other, disc, WithinDisc::subtracted, *this);
}

}  // namespace lamella
#endif
