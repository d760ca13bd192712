// A tile of a picture: one ray a pixel, and more along edges.
#pragma once

#include "engine/base/picture.h"
#include "recipe/output/preview_view.h"

namespace lamella {

inline constexpr int preview_tile = 64;  ///< px, edge of a tile

/// Draws the tile whose upper left pixel is (x, y) into the picture, as far as it lies within. Different
/// threads may draw different tiles.
void draw_tile(const PreviewView& view, int x, int y, Picture& picture);

}  // namespace lamella
