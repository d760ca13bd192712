// First-fit shelf packing.
#include "printers/vector/sheet_nesting.h"

namespace lamella {

std::optional<dvec2> ShelfSheet::place(dvec2 rectangle) {
    constexpr double rounding = 1e-6;  // mm; tolerance of sums that should fill the sheet exactly
    const double right = size_.x - margin_ + rounding;
    const double bottom = size_.y - margin_ + rounding;
    const auto put = [&](Shelf& shelf) {
        const dvec2 corner(shelf.end, size_.y - shelf.top - rectangle.y);
        shelf.height = std::max(shelf.height, rectangle.y);
        shelf.end += rectangle.x + margin_;
        return corner;
    };
    for (Shelf& shelf : shelves_) {
        const double lowest = &shelf == &shelves_.back() ? bottom : shelf.top + shelf.height;
        if (shelf.end + rectangle.x <= right && shelf.top + rectangle.y <= lowest) return put(shelf);
    }
    const double top = shelves_.empty() ? margin_ : shelves_.back().top + shelves_.back().height + margin_;
    if (margin_ + rectangle.x > right || top + rectangle.y > bottom) return std::nullopt;
    return put(shelves_.emplace_back(Shelf{top, 0, margin_}));
}

}  // namespace lamella
