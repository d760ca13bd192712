// BoxGrid: which of many boxes reach into a rectangle.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// A grid of about as many cells as boxes, with the numbers of the boxes that each cell meets.
class BoxGrid {
  public:
    explicit BoxGrid(std::span<const Rect> boxes);

    /// Calls visit(number) for the boxes that meet a rectangle, and for others near it; for some several
    /// times.
    template <typename Visit>
    void visit(const Rect& rect, const Visit& visit) const {
        const Cells cells = cells_of(rect);
        for (int y = cells.y0; y <= cells.y1; ++y) {
            for (int x = cells.x0; x <= cells.x1; ++x) {
                const std::size_t cell = cell_at(x, y);
                for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i)
                    visit(std::size_t{numbers_[i]});
            }
        }
    }

  private:
    struct Cells {
        int x0, y0, x1, y1;
    };

    std::size_t cell_at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
    }
    Cells cells_of(const Rect& rect) const {
        const auto along = [this](double v, double from, int count) {
            const double cells = (v - from) * cells_per_mm_;
            return cells > 0 ? static_cast<int>(std::min(cells, count - 1.0)) : 0;
        };
        return {along(rect.lo.x, origin_.x, columns_), along(rect.lo.y, origin_.y, rows_),
                along(rect.hi.x, origin_.x, columns_), along(rect.hi.y, origin_.y, rows_)};
    }

    dvec2 origin_{0};
    double cells_per_mm_ = 0;
    int columns_ = 1, rows_ = 1;
    std::vector<std::uint32_t> first_, numbers_;  ///< the numbers of cell c: first_[c] up to first_[c + 1]
};

}  // namespace lamella
