// BlockExtents: how far dilated runs extend on the lines of a block, as bounds over the whole block.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/morphology/ball_extents.h"

namespace lamella {

/// A rectangle of neighbouring lines of neighbouring layers.
struct LineBlock {
    std::int32_t layer, line;    ///< the first
    std::int32_t layers, lines;  ///< how many
};

/// How far a run reaches on lines of a block, run units.
struct ExtentBounds {
    std::int32_t least, most;  ///< negative where not all or none are reached
};

/// How far away a line or layer lies of `count` of them.
struct LinesAway {
    std::int32_t least, most;
    LinesAway(std::int32_t at, std::int32_t first, std::int32_t count)
        : least(std::max({first - at, at - (first + count - 1), 0})),
          most(std::max(at - first, first + count - 1 - at)) {}
};

/// How far runs reach on the lines of a block, line by line of them: looked up for balls of the table,
/// calculated for others.
class BlockExtents {
  public:
    /// `table` outlives this.
    BlockExtents(const LayerLattice& lattice, const BallExtentTable& table, const LineBlock& block)
        : lattice_(lattice), table_(table), block_(block) {}

    /// Turns to the runs of a line; lines of a layer had better follow each other.
    void set_source_line(std::int32_t layer, std::int32_t line) {
        if (layer != layer_) {
            layer_ = layer;
            up_ = LinesAway(layer, block_.layer, block_.layers);
            back_ = table_.back(up_.most, 0);
            ahead_ = table_.ahead(up_.least, 0);
        }
        across_ = LinesAway(line, block_.line, block_.lines);
        min_of_table_ = back_[std::min(across_.most, table_.lines_away())];
        max_of_table_ = ahead_[std::min(across_.least, table_.lines_away())] + 1;
        weight_ = -1;
    }
    /// Of a run of that line.
    ExtentBounds bounds(double weight) {
        if (table_.are_of(weight)) return {min_of_table_, max_of_table_};
        if (weight != weight_) calculate(weight);
        return calculated_;
    }

  private:
    void calculate(double weight) {
        weight_ = weight;
        constexpr double rounding_margin = 1;  // run units^2; far more than rounding makes
        const auto square = [](std::int32_t count, double pitch) { return count * pitch * (count * pitch); };
        const double least = weight - rounding_margin - square(across_.most, lattice_.row_pitch) -
                             square(up_.most, lattice_.layer_pitch);
        const double most = weight + rounding_margin - square(across_.least, lattice_.row_pitch) -
                            square(up_.least, lattice_.layer_pitch);
        calculated_ = {least < 0 ? -1 : static_cast<std::int32_t>(std::sqrt(least)),
                       most < 0 ? -1 : static_cast<std::int32_t>(std::sqrt(most)) + 1};
    }

    LayerLattice lattice_;
    const BallExtentTable& table_;
    LineBlock block_;
    std::int32_t layer_ = -1;
    const std::int32_t *back_ = nullptr, *ahead_ = nullptr;  // of the layer
    LinesAway up_{0, 0, 1}, across_{0, 0, 1};
    double weight_ = -1;
    std::int32_t min_of_table_ = -1, max_of_table_ = -1;
    ExtentBounds calculated_{};
};

}  // namespace lamella
