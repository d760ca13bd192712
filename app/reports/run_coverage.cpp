// Exact along runs, sampled by several lines per pixel across them.
#include "app/reports/run_coverage.h"

#include <algorithm>
#include <cmath>

#include "engine/field/slice_context.h"

namespace lamella {
namespace {

constexpr int sub_rows = 4;

}  // namespace

RunCoverage::RunCoverage(const Rect& rect, int width)
    : rect_(rect),
      width_(width),
      pixel_(rect.size().x / width),
      height_(std::max(1, static_cast<int>(std::lround(rect.size().y / pixel_)))),
      shares_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}

void RunCoverage::cover(int row, double left, double right, double share) {
    left = std::clamp(left, 0.0, double(width_));
    right = std::clamp(right, 0.0, double(width_));
    for (int i = static_cast<int>(left); i < width_ && i < right; ++i) {
        double& sum = shares_[index(i, row)];
        sum = std::min(1.0, sum + share * (std::min(right, i + 1.0) - std::max(left, i + 0.0)));
    }
}

void RunCoverage::add(const SliceField& slice) {
    RowBand band;
    band.along_origin = rect_.lo.x;
    band.across_origin = rect_.lo.y;
    band.along_pitch = band.across_pitch = pixel_;
    band.count = height_;
    band.sub = sub_rows;
    band.hi = width_;
    RunRows runs;
    Scratch scratch;
    slice.runs(band, scratch, runs);
    for (std::size_t l = 0; l < runs.lines(); ++l) {
        for (const Run& run : runs.line(l)) {
            cover(static_cast<int>(l) / sub_rows, run.begin / double{run_unit}, run.end / double{run_unit},
                  1.0 / sub_rows);
        }
    }
}

void RunCoverage::add(std::span<const PlacedRun> runs, const RowBand& band) {
    for (const PlacedRun& run : runs) {
        const dvec2 lo = (on_band(band, run.begin, run.row) - rect_.lo) / pixel_;
        const dvec2 hi = (on_band(band, run.end, run.row + 1) - rect_.lo) / pixel_;
        const int first = static_cast<int>(std::clamp(std::floor(lo.y), 0.0, double(height_)));
        const int end = static_cast<int>(std::clamp(std::ceil(hi.y), 0.0, double(height_)));
        for (int row = first; row < end; ++row)
            cover(row, lo.x, hi.x, std::min(hi.y, row + 1.0) - std::max(lo.y, row + 0.0));
    }
}

void RunCoverage::subtract(const RunCoverage& other) {
    for (std::size_t i = 0; i < shares_.size(); ++i)
        shares_[i] = std::max(0.0, shares_[i] - other.shares_[i]);
}

void RunCoverage::blur() {
    const std::vector<double> sharp = shares_;
    for (int j = 0; j < height_; ++j) {
        for (int i = 0; i < width_; ++i) {
            double sum = 0;
            for (int y = std::max(j - 1, 0); y <= std::min(j + 1, height_ - 1); ++y) {
                for (int x = std::max(i - 1, 0); x <= std::min(i + 1, width_ - 1); ++x)
                    sum += sharp[index(x, y)];
            }
            shares_[index(i, j)] = sum / 9;
        }
    }
}

}  // namespace lamella
