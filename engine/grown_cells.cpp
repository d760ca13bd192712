// Cells grown by discs: each line is spread step by step and added to those that the disc reaches. Compiled
// for every SIMD target; words are whole numbers, so that every target gives the same bits.
#include <algorithm>
#include <cstring>

#include "engine/cell_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/grown_cells.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/aligned_allocator.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lamella {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<std::uint64_t, CellLattice::words_at_once>;

/// to = from, and from moved by `cells` (1 to 63) to either side. There are empty words about both.
HWY_INLINE void spread(const std::uint64_t* from, int cells, std::size_t words, std::uint64_t* to) {
    const Words d;
    const int others = 64 - cells;
    for (std::size_t i = 0; i < words; i += hn::Lanes(d)) {
        const auto here = hn::Load(d, from + i), before = hn::LoadU(d, from + i - 1),
                   behind = hn::LoadU(d, from + i + 1);
        const auto up = hn::Or(hn::ShiftLeftSame(here, cells), hn::ShiftRightSame(before, others)),
                   down = hn::Or(hn::ShiftRightSame(here, cells), hn::ShiftLeftSame(behind, others));
        hn::Store(hn::Or(here, hn::Or(up, down)), d, to + i);
    }
}

HWY_INLINE void add(const std::uint64_t* from, std::size_t words, std::uint64_t* to) {
    const Words d;
    for (std::size_t i = 0; i < words; i += hn::Lanes(d))
        hn::StoreU(hn::Or(hn::LoadU(d, to + i), hn::Load(d, from + i)), d, to + i);
}

void grow_cells(const CellRows& cells, const DiscWidths& disc, CellRows& all) {
    const std::size_t words = cells.lattice().words, lines = cells.lattice().lines;
    // Aligned, and with an empty word before and behind each.
    constexpr std::size_t beside = CellLattice::words_at_once;
    const auto buffers = hwy::AllocateAligned<std::uint64_t>(2 * words + 3 * beside);
    std::fill_n(buffers.get(), 2 * words + 3 * beside, 0);
    std::uint64_t *line = buffers.get() + beside, *next = line + words + beside;
    for (std::size_t l = 0; l < lines; ++l) {
        if (!cells.any_in_line(l)) continue;
        std::copy_n(cells.line(l), words, line);
        std::int32_t width = 0;
        for (std::size_t k = disc.size(); k-- > 0;) {
            while (width < disc[k]) {
                // No cell between the moved ones may be left out, not even where those to one side lie beyond
                // the end of the line and are lost.
                const std::int32_t step = std::min({disc[k] - width, width + 1, 63});
                spread(line, step, words, next);
                std::swap(line, next);
                width += step;
            }
            if (k <= l) add(line, words, all.line(l - k));
            if (k > 0 && l + k < lines) add(line, words, all.line(l + k));
        }
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
    HWY_DYNAMIC_DISPATCH(grow_cells)(*this, disc, all);
    return all;
}

}  // namespace lamella
#endif
