// Whether bands that leave lines out give the same runs as those that do not.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/field/field.h"
#include "engine/field/slice_context.h"

namespace lamella {

/// Requires that each line of a slice's bands with steps has the runs that it has in the whole band, a few
/// rows at a time and all at once. Returns the runs compared.
inline std::size_t require_same_lines_by_steps(const SliceField& slice, const RowBand& whole) {
    Scratch scratch;
    RunRows all, some;
    slice.runs(whole, scratch, all);
    std::size_t compared = 0;
    for (const int step : {2, 3, 13}) {
        for (const int rows : {2, 11, whole.count}) {
            INFO("each " << step << ". line, " << rows << " rows at a time");
            RowBand band = whole;
            band.step = step;
            int lines = 0;
            for (; band.first < whole.first + whole.count; band.first += rows) {
                band.count = std::min(rows, whole.first + whole.count - band.first);
                slice.runs(band, scratch, some);
                REQUIRE(some.lines() == static_cast<std::size_t>(band.lines()));
                lines += band.lines();
                for (int l = 0; l < band.lines(); ++l) {
                    const auto got = some.line(static_cast<std::size_t>(l)),
                               expected =
                                   all.line(static_cast<std::size_t>(band.number(l) - whole.number(0)));
                    REQUIRE(std::ranges::equal(got, expected));
                    compared += got.size();
                }
            }
            REQUIRE(lines >= whole.lines() / step);
            REQUIRE(lines <= whole.lines() / step + 1);
        }
    }
    return compared;
}

}  // namespace lamella
