// BlockExtents: how far dilated runs extend on the lines of a block, as bounds over the whole block.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/morphology/ball_extents.h"

namespace lamella {

/// A rectangle of neighbouring lines of neighbouring layers.
struct LineBlock {
    std::int32_t layer, line;    ///< first layer and line
    std::int32_t layers, lines;  ///< number of layers and lines
};

/// Bounds, over all lines of a block, on how far a dilated run extends beyond its own ends; run units.
struct ExtentBounds {
    /// Lower bound: negative unless the ball reaches every line. Upper bound: negative if it reaches no line.
    std::int32_t least, most;
};

/// The least and the greatest distance, in lines or layers, from number `at` to the `count` numbers from
/// `first` on.
struct LinesAway {
    std::int32_t least, most;
    LinesAway(std::int32_t at, std::int32_t first, std::int32_t count)
        : least(std::max({first - at, at - (first + count - 1), 0})),
          most(std::max(at - first, first + count - 1 - at)) {}
};

/// Extent bounds of the runs around a block, queried one source line at a time. They are looked up for balls
/// of the table's radius and calculated for all others.
class BlockExtents {
  public:
    /// `table` outlives this.
    BlockExtents(const LayerLattice& lattice, const BallExtentTable& table, const LineBlock& block)
        : lattice_(lattice), table_(table), block_(block) {}

    /// Selects the line that contains the runs of the next queries. The lookup of the layer is cached, so
    /// visit all lines of a layer before those of another.
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
    /// Returns the extent bounds of a run of the selected line with that squared radius.
    ExtentBounds bounds(double weight) {
        if (table_.are_of(weight)) return {min_of_table_, max_of_table_};
        if (weight != weight_) calculate(weight);
        return calculated_;
    }

  private:
    void calculate(double weight) {
        weight_ = weight;
        constexpr double rounding_margin = 1;  // run units^2; far more than the rounding error
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
    const std::int32_t *back_ = nullptr, *ahead_ = nullptr;  // table rows of the selected layer
    LinesAway up_{0, 0, 1}, across_{0, 0, 1};
    double weight_ = -1;
    std::int32_t min_of_table_ = -1, max_of_table_ = -1;
    ExtentBounds calculated_{};
};

}  // namespace lamella
