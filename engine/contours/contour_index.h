// ContourIndex: a layer's border in square cells, for distance queries.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/contours/contours.h"

namespace lamella {

/// Answers distance queries about the border of a layer. Immutable once made; any thread may query it.
class ContourIndex {
  public:
    ContourIndex() = default;
    /// `cell` > 0, mm: at least about the distance of the queries.
    ContourIndex(const std::vector<Contour>& contours, double cell);

    /// Returns the signed distance to the border, negative inside, mm; nothing when no border lies within
    /// `limit`.
    std::optional<double> distance(dvec2 p, double limit) const;
    /// Returns how far a ray from a point of the border, along a unit direction into the solid, runs before
    /// it meets the border again; at most `limit`, mm.
    double way_through(dvec2 p, dvec2 direction, double limit) const;

  private:
    struct Piece {
        dvec2 from;
        dvec2 to;
    };
    struct Cells {
        int x0, x1, y0, y1;
    };
    Cells cells(const Rect& r) const;
    std::size_t number(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(x);
    }
    void add_pieces(const Contour& contour);
    template <typename Visit>
    void visit(const Rect& r, const Visit& visit) const;

    dvec2 origin_{0};
    double cell_ = 1;
    int nx_ = 0, ny_ = 0;
    std::vector<Piece> pieces_;          ///< at most a cell long
    std::vector<std::uint32_t> starts_;  ///< of each cell, plus the end of the last
    std::vector<std::uint32_t> items_;
};

}  // namespace lamella
