// LayerAreas: what a layer's mask lights, island by island.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/contours/coverage.h"
#include "engine/runs/runs.h"

namespace lamella {

/// Areas in pixels; a grey pixel counts by its grey.
struct LayerFigures {
    double total = 0;
    double largest = 0;   ///< of one island
    double smallest = 0;  ///< of one island
    int islands = 0;      ///< sets of pixels that light up and touch, be it by a corner
    /// What lights up lies in columns [min_x, max_x) and rows [min_y, max_y); all 0 where nothing does.
    int min_x = 0, min_y = 0, max_x = 0, max_y = 0;
};

/// Takes a mask's runs from the top and tells the areas of its islands. Memory: the runs that light up.
class LayerAreas {
  public:
    explicit LayerAreas(int width) : width_(width) {}
    /// The next runs; those of a row sum to the width.
    void add(std::span<const GreyRun> runs);
    /// What the rows so far make.
    LayerFigures figures() const;

  private:
    void end_lit();

    int width_;
    int column_ = 0;
    int lit_begin_ = 0;                 ///< of the run that lights up and is not yet ended
    std::uint64_t lit_grey_ = 0;        ///< its sum of greys; 0 where there is none
    RunRows lit_;                       ///< in pixels
    std::vector<std::uint64_t> greys_;  ///< sums, of each run of lit_
};

}  // namespace lamella
