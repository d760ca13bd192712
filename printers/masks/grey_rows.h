// Rows of grey runs: joins runs, combines the rows of two images, and maps their grey values.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/contours/coverage.h"
#include "printers/common/profile.h"

namespace lamella {

/// Joins successive runs of equal value within a row.
class RowJoiner {
  public:
    RowJoiner(std::vector<GreyRun>& out, int width) : out_(out), width_(static_cast<std::uint32_t>(width)) {}
    void push(std::uint32_t length, std::uint16_t value) {
        if (column_ > 0 && out_.back().value == value) {
            out_.back().length += length;
        } else {
            out_.push_back({length, value});
        }
        column_ = column_ + length == width_ ? 0 : column_ + length;
    }

  private:
    std::vector<GreyRun>& out_;
    std::uint32_t width_;
    std::uint32_t column_ = 0;
};

/// Combines the values of two images of the same rows, pixel by pixel, and calls push(length, value) for each
/// resulting run. Values may be sums of greys.
template <typename Run, typename Combine, typename Push>
void combine_rows(const std::vector<Run>& a, const std::vector<GreyRun>& b, const Combine& combine,
                  const Push& push) {
    std::uint32_t left_a = 0, left_b = 0;
    for (std::size_t i = 0, j = 0; i < a.size();) {
        if (left_a == 0) left_a = a[i].length;
        if (left_b == 0) left_b = b[j].length;
        const std::uint32_t length = std::min(left_a, left_b);
        push(length, combine(a[i].value, b[j].value));
        if ((left_a -= length) == 0) ++i;
        if ((left_b -= length) == 0) ++j;
    }
}

/// Maps each grey value, from 0 to white, to another one.
using GreyTable = std::vector<std::uint16_t>;

/// Returns the table that turns coverage into grey: the gamma and the limits of the display, times `share` (0
/// to 1). Zero coverage stays black. The table has white_of(profile) + 1 entries.
GreyTable grey_table(const ImageProfile& profile, double share);

/// Returns the grey of a fully covered pixel.
int white_of(const ImageProfile& profile);

/// Maps the values of rows of `width` pixels. `spare` is scratch memory.
void apply(const GreyTable& table, int width, std::vector<GreyRun>& runs, std::vector<GreyRun>& spare);

}  // namespace lamella
