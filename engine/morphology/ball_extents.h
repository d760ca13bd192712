// BallExtentTable: how far a ball extends on the lines around its centre, as a lookup table.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/morphology/weighted_rows.h"

namespace lamella {

/// A lookup table of the extents of a ball, in run units, by the number of lines and layers from its centre.
/// The table is padded so that a block of `edge` layers of `edge` lines can be read at any offset.
class BallExtentTable {
  public:
    static constexpr std::int32_t edge = 8;
    /// The extent on lines that the ball does not reach. Added to any run end it stays below all coordinates
    /// and does not overflow.
    static constexpr std::int32_t none = -(1 << 30);

    /// `weight` is the squared radius, as in WeightedRun. A ball that reaches very many lines gets no table;
    /// weight() is negative then.
    BallExtentTable(const LayerLattice& lattice, double weight);

    /// Returns true if the table is for balls of that weight.
    bool are_of(double weight) const { return weight == weight_; }
    /// Returns the squared radius of the balls; negative if there is no table.
    double weight() const { return weight_; }
    /// Returns the extents by which run ends grow forward on the lines of a block. The block's first line
    /// lies `layers` above and `lines` behind the ball's centre. Entries of neighbouring lines follow each
    /// other, those of neighbouring layers are `stride()` apart.
    const std::int32_t* ahead(std::int32_t layers, std::int32_t lines) const {
        return ahead_.data() + place(layers, lines);
    }
    /// Returns the extents by which run begins grow backward, in the same order.
    const std::int32_t* back(std::int32_t layers, std::int32_t lines) const {
        return back_.data() + place(layers, lines);
    }
    /// Clamps a number of lines to the table. Entries at the clamped number are beyond the ball if the
    /// original ones are. A clamped number can be added to the pointer that ahead() or back() returns for 0
    /// lines.
    std::int32_t clamped_lines(std::int32_t lines) const {
        return std::clamp(lines, -lines_ - edge, lines_ + 1);
    }
    /// Returns the smallest tabulated number of lines that is out of the ball's reach.
    std::int32_t lines_away() const { return lines_ + 1; }
    std::size_t stride() const { return 2 * static_cast<std::size_t>(lines_ + edge) + 1; }

  private:
    std::size_t place(std::int32_t layers, std::int32_t lines) const {
        const std::int32_t row = std::clamp(layers, -layers_ - edge, layers_ + 1) + layers_ + edge;
        return static_cast<std::size_t>(row) * stride() +
               static_cast<std::size_t>(clamped_lines(lines) + lines_ + edge);
    }

    double weight_;
    std::int32_t layers_ = 0, lines_ = 0;  // that the ball reaches to either side, rounded up
    std::vector<std::int32_t> ahead_, back_;
};

}  // namespace lamella
