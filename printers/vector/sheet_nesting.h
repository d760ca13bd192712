// Laying rectangles out on a sheet, one after the other, in shelves.
#pragma once

#include <optional>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// One sheet that is filled from the top left: each rectangle goes to the first shelf that has room for it,
/// else to a new shelf below (first fit by shelves, without turning). Only the lowest shelf may still grow.
class ShelfSheet {
  public:
    /// `margin` stays free at the edges and between rectangles, mm.
    ShelfSheet(dvec2 size, double margin) : size_(size), margin_(margin) {}

    /// Lower left corner of a rectangle of this size, y upwards, mm; nothing where there is no room left.
    std::optional<dvec2> place(dvec2 rectangle);
    bool empty() const { return shelves_.empty(); }

  private:
    struct Shelf {
        double top = 0;     // below the sheet's upper edge
        double height = 0;  // of the highest rectangle
        double end = 0;     // x behind the last rectangle and its margin
    };
    dvec2 size_;
    double margin_;
    std::vector<Shelf> shelves_;
};

/// The largest rectangle that a sheet holds, mm.
inline dvec2 usable_sheet_size(dvec2 size, double margin) { return size - dvec2(2 * margin); }

}  // namespace lamella
