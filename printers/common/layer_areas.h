// LayerAreas: areas of the islands of a layer's mask.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/contours/coverage.h"
#include "engine/runs/runs.h"

namespace lamella {

/// Areas and extent of a mask. Areas in pixels; a grey pixel counts in proportion to its grey.
struct LayerFigures {
    double total = 0;
    double largest = 0;   ///< area of the largest island
    double smallest = 0;  ///< area of the smallest island
    int islands = 0;      ///< number of 8-connected components of pixels that are not black
    /// Bounding box of the pixels that are not black: columns [min_x, max_x), rows [min_y, max_y). All 0 if
    /// every pixel is black.
    int min_x = 0, min_y = 0, max_x = 0, max_y = 0;
};

/// Computes the areas of a mask's islands from its runs, from the top row down. Memory: the runs that are not
/// black.
class LayerAreas {
  public:
    explicit LayerAreas(int width) : width_(width) {}
    /// Appends the next runs. The runs of each row sum to the width.
    void add(std::span<const GreyRun> runs);
    /// Returns the figures of all rows so far.
    LayerFigures figures() const;

  private:
    void end_lit();

    int width_;
    int column_ = 0;
    int lit_begin_ = 0;                 ///< start of the current run of lit pixels
    std::uint64_t lit_grey_ = 0;        ///< sum of the greys of that run; 0 if there is none
    RunRows lit_;                       ///< in pixels
    std::vector<std::uint64_t> greys_;  ///< sum of greys of each run of lit_
};

}  // namespace lamella
