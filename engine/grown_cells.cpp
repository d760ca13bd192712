// Cells grown by discs, a few lines at once, from the middle of the disc outward: what has come in of nearer
// lines is widened once more with each line further away, so that it ends up widest. Compiled for every SIMD
// target; words are whole numbers, so that every target gives the same bits.
#include <algorithm>

#include "engine/cell_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/grown_cells.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/aligned_allocator.h>
#include <hwy/highway.h>

#ifndef LAMELLA_GROWN_CELLS_RESULT
#define LAMELLA_GROWN_CELLS_RESULT
namespace lamella {

/// What becomes of cells within a disc.
enum class WithinDisc : std::uint8_t { kept, left_out, subtracted };

}  // namespace lamella
#endif

HWY_BEFORE_NAMESPACE();
namespace lamella {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lines = hn::CappedTag<std::uint64_t, CellLattice::lines_at_once>;

/// The words of a few lines, column by column.
class LineBlock {
  public:
    explicit LineBlock(std::size_t words)
        : words_(words), block_(hwy::AllocateAligned<std::uint64_t>(words * hn::Lanes(Lines()))) {}

    void clear() { std::fill_n(block_.get(), words_ * hn::Lanes(Lines()), 0); }
    /// Adds the cells of the lines that begin here, and there, and then all up to so many to either side.
    void add_and_widen(const CellRows& cells, std::ptrdiff_t here, std::ptrdiff_t there, std::int32_t by) {
        const auto sum = [&](std::size_t i) {
            const Lines d;
            const std::uint64_t* const words = cells.column(i);
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
    /// Adds all cells up to so many to either side, where so many are there.
    void widen(std::int32_t width, std::int32_t to) {
        while (width < to) {
            // No cell between the moved ones may be left out.
            const std::int32_t step = std::min({to - width, width + 1, 63});
            add_moved(step, [&](std::size_t i) { return hn::Load(Lines(), at(i)); });
            width += step;
        }
    }
    void write(std::ptrdiff_t line, WithinDisc within, CellRows& to) const {
        const Lines d;
        for (std::size_t i = 0; i < words_; ++i) {
            std::uint64_t* const words = to.column(i) + line;
            const auto grown = hn::Load(d, at(i));
            if (within == WithinDisc::kept) hn::StoreU(grown, d, words);
            if (within == WithinDisc::left_out) hn::StoreU(hn::Not(grown), d, words);
            if (within == WithinDisc::subtracted)
                hn::StoreU(hn::AndNot(grown, hn::LoadU(d, words)), d, words);
        }
    }

  private:
    /// Turns into what words(i) tells and the same moved by `cells` (1 to 63) to either side.
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

    std::size_t words_;
    hwy::AlignedFreeUniquePtr<std::uint64_t[]> block_;
};

void grow_cells(const CellRows& cells, const DiscWidths& disc, WithinDisc within, CellRows& to) {
    const auto lines = static_cast<std::ptrdiff_t>(cells.lattice().lines),
               at_once = static_cast<std::ptrdiff_t>(hn::Lanes(Lines())),
               reach = static_cast<std::ptrdiff_t>(disc.size()) - 1;
    LineBlock block(cells.lattice().words);
    for (std::ptrdiff_t l = 0; l < lines; l += at_once) {
        block.clear();
        for (std::ptrdiff_t k = 0; k <= reach; ++k) {
            const auto at = static_cast<std::size_t>(k);
            const std::int32_t by = disc[at] - (k < reach ? disc[at + 1] : 0);
            // Beyond the lattice there is nothing to add.
            const std::ptrdiff_t before = l - k, behind = l + k;
            const bool any_before = before + at_once > 0, any_behind = behind < lines;
            if (any_before || any_behind) {
                block.add_and_widen(cells, any_before ? before : behind, any_behind ? behind : before, by);
            } else {
                block.widen(0, by);
            }
        }
        block.write(l, within, to);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace lamella
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lamella {

HWY_EXPORT(grow_cells);

CellRows CellRows::grown(const DiscWidths& disc) const {
    CellRows all(lattice_);
    HWY_DYNAMIC_DISPATCH(grow_cells)(*this, disc, WithinDisc::kept, all);
    return all;
}

CellRows CellRows::beyond(const DiscWidths& disc) const {
    CellRows others(lattice_);
    HWY_DYNAMIC_DISPATCH(grow_cells)(*this, disc, WithinDisc::left_out, others);
    return others;
}

void CellRows::subtract_grown(const CellRows& other, const DiscWidths& disc) {
    HWY_DYNAMIC_DISPATCH(grow_cells)(other, disc, WithinDisc::subtracted, *this);
}

}  // namespace lamella
#endif
