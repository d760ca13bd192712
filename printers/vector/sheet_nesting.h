// ShelfSheet: places rectangles on a sheet in shelves, one after another.
#pragma once

#include <optional>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// A sheet that is filled from the top left. Each rectangle goes to the first shelf with room for it,
/// otherwise to a new shelf below (first-fit shelf packing, without rotation). Only the lowest shelf may
/// still grow.
class ShelfSheet {
  public:
    /// `margin` stays free along the edges and between rectangles, mm.
    ShelfSheet(dvec2 size, double margin) : size_(size), margin_(margin) {}

    /// Places a rectangle and returns its lower left corner, y upwards, mm; nothing if there is no room.
    std::optional<dvec2> place(dvec2 rectangle);
    bool empty() const { return shelves_.empty(); }

  private:
    struct Shelf {
        double top = 0;     // distance from the sheet's upper edge
        double height = 0;  // height of the tallest rectangle
        double end = 0;     // x after the last rectangle and its margin
    };
    dvec2 size_;
    double margin_;
    std::vector<Shelf> shelves_;
};

/// Returns the size of the largest rectangle that fits on a sheet, mm.
inline dvec2 usable_sheet_size(dvec2 size, double margin) { return size - dvec2(2 * margin); }

}  // namespace lamella
