// Renders all rows in bands of 64.
#include "app/reports/grey_page.h"

#include <algorithm>

#include "engine/contours/coverage.h"
#include "engine/field/slice_context.h"

namespace lamella {

std::vector<std::uint8_t> grey_page(const SliceField& slice, const RowBand& page, bool antialiased) {
    constexpr int rows_at_once = 64;
    std::vector<std::uint8_t> grey;
    grey.reserve(static_cast<std::size_t>(page.hi) * static_cast<std::size_t>(page.count));
    Scratch scratch;
    RunRows rows;
    std::vector<GreyRun> runs;
    for (RowBand band = page; band.first < page.count; band.first += rows_at_once) {
        band.count = std::min(rows_at_once, page.count - band.first);
        rows.clear();
        runs.clear();
        slice.runs(band, scratch, rows);
        antialiased ? coverage(band, rows, runs) : threshold(band, rows, runs);
        for (const GreyRun& run : runs)
            grey.insert(grey.end(), run.length, static_cast<std::uint8_t>(run.value));
    }
    return grey;
}

}  // namespace lamella
