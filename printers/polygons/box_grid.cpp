// Counts the boxes of each cell, and then places their numbers.
#include "printers/polygons/box_grid.h"

#include <cmath>

namespace lamella {

BoxGrid::BoxGrid(std::span<const Rect> boxes) {
    Rect all;
    for (const Rect& box : boxes) all = unite(all, box);
    const dvec2 size = all.size();
    const double longest = std::max(size.x, size.y);
    if (longest > 0 && !boxes.empty()) {
        origin_ = all.lo;
        const auto count = static_cast<double>(boxes.size());
        cells_per_mm_ = std::sqrt(count / std::max(size.x * size.y, longest * longest / count));
        columns_ = static_cast<int>(size.x * cells_per_mm_) + 1;
        rows_ = static_cast<int>(size.y * cells_per_mm_) + 1;
    }
    first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
    const auto for_cells = [&](const Rect& box, const auto& act) {
        const Cells cells = cells_of(box);
        for (int y = cells.y0; y <= cells.y1; ++y) {
            for (int x = cells.x0; x <= cells.x1; ++x) act(cell_at(x, y));
        }
    };
    for (const Rect& box : boxes) for_cells(box, [&](std::size_t cell) { ++first_[cell + 1]; });
    for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
    numbers_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for_cells(boxes[i],
                  [&](std::size_t cell) { numbers_[next[cell]++] = static_cast<std::uint32_t>(i); });
}

}  // namespace lamella
