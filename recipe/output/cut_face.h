// CutFace: the section of two solids where a picture cuts them open.
#pragma once

#include <cstdint>
#include <vector>

#include "recipe/output/coverage_grid.h"

namespace lamella {

/// Made from exact runs along lines of the plane, four of them a cell of the grid.
class CutFace {
  public:
    enum class Kind : unsigned char { none, part, second };

    /// Cuts within the bounds, along an axis at `plane.at`, mm. Uses the calling task arena's threads. Throws
    /// Interrupted when cancelled.
    CutFace(const TwoSolids& solids, const Box& bounds, const PreviewCut& plane, double pitch,
            const CancelToken* cancel);

    /// Returns what there is at a point of the plane, mm.
    Kind at(dvec3 p) const;

  private:
    double share(const std::vector<std::uint8_t>& shares, dvec2 at) const;
    void fill_rows(const TwoSolids& solids, int first, int count, const PreviewCut& plane);
    void store(const RunRows& rows, int first, std::vector<std::uint8_t>& shares) const;

    Box bounds_;
    int along_, across_;  ///< axes of the lines, and from line to line
    double pitch_;        ///< of the lines, and of the shares along them, mm
    int width_, height_;
    std::vector<std::uint8_t> part_, all_;  ///< shares of pixels; `all_` is empty without a second solid
};

}  // namespace lamella
