// A sheet of pictures: the part in several orientations.
#pragma once

#include <vector>

#include "engine/base/picture.h"
#include "recipe/placement/orient_part.h"

namespace lamella {

/// Draws the first ten orientations in rows of five, numbered from 1 and seen from the front, a little from
/// below; surfaces that need supports are red. `threads`: 0: one per core. Throws InputError when the body
/// cannot be made or there is no orientation.
Picture orientation_sheet(const Recipe& recipe, const std::vector<Orientation>& orientations, int threads);

}  // namespace lamella
