// Rows with a squared radius for each run: a ball is centred at each of its points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/morphology/power_cell_bounds.h"
#include "engine/runs/runs.h"

namespace lamella {

/// A run coordinate beyond all solids, run units. The void extends from -unbounded to unbounded or farther.
/// Run ends there are not moved by a dilation.
inline constexpr std::int32_t unbounded = 1 << 29;

/// A solid interval of a line, with the radius of the ball about each of its points.
struct WeightedRun {
    std::int32_t begin;  ///< as in Run
    std::int32_t end;
    double weight;  ///< square of the ball's radius, run units^2
    friend bool operator==(const WeightedRun&, const WeightedRun&) = default;
};

/// The whole numbers of units by which a dilation by `reach` moves the begin and the end of a run, if moved
/// ends are rounded to the nearest unit, halves upward.
struct RoundedExtent {
    std::int32_t back, ahead;
    explicit RoundedExtent(double reach) : back(static_cast<std::int32_t>(2 * reach + 1) / 2), ahead(back) {
        if (back - reach == 0.5) --back;
    }
};

/// The rows of a layer, with the squared radius of the ball for each run.
class WeightedRows {
  public:
    WeightedRows() : starts_(1, 0) {}
    /// Gives all runs the same radius, run units.
    WeightedRows(const RunRows& rows, double radius);

    std::size_t lines() const { return starts_.size() - 1; }
    std::span<const WeightedRun> line(std::size_t l) const {
        return {runs_.data() + starts_[l], starts_[l + 1] - starts_[l]};
    }
    std::span<const WeightedRun> runs() const { return runs_; }
    /// Returns the index in runs() of a line's first run; the number of runs for `l` = lines().
    std::size_t start(std::size_t l) const { return starts_[l]; }
    /// Returns the line of each run.
    std::span<const std::int32_t> lines_of_runs() const { return lines_of_runs_; }
    double max_weight() const { return max_weight_; }
    /// Returns on which lines each run may be visible; empty unless begin_sights() was called.
    std::span<const PowerCellBounds> sights() const { return sights_; }
    /// Returns those of a line, to be limited; only after begin_sights().
    std::span<PowerCellBounds> sights(std::size_t l) {
        return std::span(sights_).subspan(starts_[l], starts_[l + 1] - starts_[l]);
    }
    /// Gives each run an unlimited power cell.
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

/// The lattice of a stack of layers. Lengths in run units, 1/256 of the pitch along lines. A flattened ball,
/// which reaches less far along z than within the layer, is described by a layer pitch that is larger by that
/// ratio. An infinite layer pitch keeps balls within their layer.
struct LayerLattice {
    double row_pitch = run_unit;    ///< from line to line
    double layer_pitch = run_unit;  ///< from layer to layer
    std::size_t lines = 0;          ///< of each layer

    /// Returns how many lines a ball of radius `reach` reaches to either side.
    std::size_t lines_within(double reach) const { return static_cast<std::size_t>(reach / row_pitch); }
    /// Returns how many layers a ball of radius `reach` reaches up and down.
    std::size_t layers_within(double reach) const { return static_cast<std::size_t>(reach / layer_pitch); }
};

}  // namespace lamella
