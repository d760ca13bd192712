// How far the pixels of a picture are covered by runs.
#pragma once

#include <span>
#include <vector>

#include "engine/field/field.h"
#include "engine/runs/run_components.h"

namespace lamella {

/// A rectangle of a layer's plane in square pixels, each with the share of it that is covered, 0 to 1. Rows
/// go along y, from the lower side up.
class RunCoverage {
  public:
    /// `width`: pixels along x.
    RunCoverage(const Rect& rect, int width);

    int width() const { return width_; }
    int height() const { return height_; }
    double pixel() const { return pixel_; }  ///< mm
    double at(int column, int row) const { return shares_[index(column, row)]; }

    /// Adds what a slice covers.
    void add(const SliceField& slice);
    /// Adds what runs cover that lie as `band` says, each as high as its row.
    void add(std::span<const PlacedRun> runs, const RowBand& band);
    /// Takes away what another one of the same size covers.
    void subtract(const RunCoverage& other);
    /// Each pixel becomes the mean of the three by three about it.
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
