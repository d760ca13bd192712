// BallExtentTable: how far a ball extends on the lines around its centre, as a lookup table.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/morphology/weighted_rows.h"

namespace lamella {

/// The reaches of balls of one radius, run units: a table of lines and layers, wide enough to read a block of
/// `edge` layers of as many lines wherever it lies.
class BallExtentTable {
  public:
    static constexpr std::int32_t edge = 8;
    /// On lines beyond the ball. Less than what any line can hold, and may be added to it.
    static constexpr std::int32_t none = -(1 << 30);

    /// `weight` is the square of the radius, as of WeightedRun. Balls that reach very many lines get no
    /// table.
    BallExtentTable(const LayerLattice& lattice, double weight);

    /// Whether these are the reaches of balls of that weight.
    bool are_of(double weight) const { return weight == weight_; }
    /// Square of the balls' radius; negative where there is no table.
    double weight() const { return weight_; }
    /// By how far ends move ahead on the lines of a block, of which the first lies so many layers above and
    /// lines behind the ball's. Layers are `stride()` apart.
    const std::int32_t* ahead(std::int32_t layers, std::int32_t lines) const {
        return ahead_.data() + place(layers, lines);
    }
    /// By how far begins move back, so.
    const std::int32_t* back(std::int32_t layers, std::int32_t lines) const {
        return back_.data() + place(layers, lines);
    }
    /// So many lines, or as many as the table has: beyond all balls. Up to these, reaches lie one after
    /// another.
    std::int32_t clamped_lines(std::int32_t lines) const {
        return std::clamp(lines, -lines_ - edge, lines_ + 1);
    }
    /// Balls reach no line that is so many lines away.
    std::int32_t lines_away() const { return lines_ + 1; }
    std::size_t stride() const { return 2 * static_cast<std::size_t>(lines_ + edge) + 1; }

  private:
    std::size_t place(std::int32_t layers, std::int32_t lines) const {
        const std::int32_t row = std::clamp(layers, -layers_ - edge, layers_ + 1) + layers_ + edge;
        return static_cast<std::size_t>(row) * stride() +
               static_cast<std::size_t>(clamped_lines(lines) + lines_ + edge);
    }

    double weight_;
    std::int32_t layers_ = 0, lines_ = 0;  // that it reaches to either side
    std::vector<std::int32_t> ahead_, back_;
};

}  // namespace lamella
