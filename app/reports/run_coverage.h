// RunCoverage: the coverage of a picture's pixels by runs.
#pragma once

#include <span>
#include <vector>

#include "engine/field/field.h"
#include "engine/runs/run_components.h"

namespace lamella {

/// A rectangle of a layer's plane in square pixels, each with its covered share, 0 to 1. Rows go along y,
/// from the lower side up.
class RunCoverage {
  public:
    /// `width`: pixels along x.
    RunCoverage(const Rect& rect, int width);

    int width() const { return width_; }
    int height() const { return height_; }
    double pixel() const { return pixel_; }  ///< mm
    double at(int column, int row) const { return shares_[index(column, row)]; }

    /// Adds the coverage of a slice.
    void add(const SliceField& slice);
    /// Adds the coverage of runs on the lines of `band`, each as high as its row.
    void add(std::span<const PlacedRun> runs, const RowBand& band);
    /// Subtracts the coverage of another object of the same size.
    void subtract(const RunCoverage& other);
    /// Replaces each pixel by the mean of its 3 x 3 neighbourhood.
    void blur();

  private:
    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(column);
    }
    void cover(int row, double left, double right, double share);

    Rect rect_;
    int width_;
    double pixel_;
    int height_;
    std::vector<double> shares_;
};

}  // namespace lamella
