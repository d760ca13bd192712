// Rows with a squared radius for each run: a ball is centred at each of its points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/morphology/power_cell_bounds.h"
#include "engine/runs/runs.h"

namespace lamella {

/// Run units; solids lie within, the void reaches up to it or beyond. What lies there is not moved by balls.
inline constexpr std::int32_t unbounded = 1 << 29;

/// A solid interval of a line and how far a ball about it reaches.
struct WeightedRun {
    std::int32_t begin;  ///< as of Run
    std::int32_t end;
    double weight;  ///< square of the ball's radius, run units^2
    friend bool operator==(const WeightedRun&, const WeightedRun&) = default;
};

/// By how many units a reach moves ends of runs when these are rounded to the nearest unit, halves upward.
struct RoundedExtent {
    std::int32_t back, ahead;
    explicit RoundedExtent(double reach) : back(static_cast<std::int32_t>(2 * reach + 1) / 2), ahead(back) {
        if (back - reach == 0.5) --back;
    }
};

/// The rows of a layer with the square of the ball's radius at each run.
class WeightedRows {
  public:
    WeightedRows() : starts_(1, 0) {}
    /// The same radius everywhere, run units.
    WeightedRows(const RunRows& rows, double radius);

    std::size_t lines() const { return starts_.size() - 1; }
    std::span<const WeightedRun> line(std::size_t l) const {
        return {runs_.data() + starts_[l], starts_[l + 1] - starts_[l]};
    }
    std::span<const WeightedRun> runs() const { return runs_; }
    /// The place in runs() of a line's first run; of what lies behind the last line, the number of runs.
    std::size_t start(std::size_t l) const { return starts_[l]; }
    /// The line of each run.
    std::span<const std::int32_t> lines_of_runs() const { return lines_of_runs_; }
    double max_weight() const { return max_weight_; }
    /// On which lines each run may matter; empty if that is unknown.
    std::span<const PowerCellBounds> sights() const { return sights_; }
    /// Those of a line, to be limited once they have begun.
    std::span<PowerCellBounds> sights(std::size_t l) {
        return std::span(sights_).subspan(starts_[l], starts_[l + 1] - starts_[l]);
    }
    /// Begins with unlimited ones.
    void begin_sights() { sights_.assign(runs_.size(), PowerCellBounds()); }
    void append_line(std::span<const WeightedRun> runs);

  private:
    void end_line();

    std::vector<WeightedRun> runs_;
    std::vector<std::int32_t> lines_of_runs_;
    std::vector<PowerCellBounds> sights_;
    std::vector<std::size_t> starts_;
    double max_weight_ = 0;
};

/// The lattice of a stack of layers. Lengths in run units, 1/256 of the pitch along lines; where a ball
/// reaches less far up than across, layers are that much farther apart.
struct LayerLattice {
    double row_pitch = run_unit;    ///< from line to line
    double layer_pitch = run_unit;  ///< from layer to layer
    std::size_t lines = 0;          ///< of each layer

    /// How many lines, or layers, a ball reaches to either side.
    std::size_t lines_within(double reach) const { return static_cast<std::size_t>(reach / row_pitch); }
    std::size_t layers_within(double reach) const { return static_cast<std::size_t>(reach / layer_pitch); }
};

}  // namespace lamella
