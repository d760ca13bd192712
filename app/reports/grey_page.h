// The coverage of a page of pixels by a slice.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/field/field.h"

namespace lamella {

/// Returns a byte for each pixel of a page, row by row: the covered share of the pixel, or 0 or 255 without
/// antialiasing. `page` has the rows of pixels, with the lines that are sampled of each.
std::vector<std::uint8_t> grey_page(const SliceField& slice, const RowBand& page, bool antialiased);

}  // namespace lamella
