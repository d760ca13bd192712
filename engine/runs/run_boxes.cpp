// Lookups by layer and row.
#include "engine/runs/run_boxes.h"

#include <algorithm>

namespace lamella {
namespace {

/// Returns the index of the cell of a regular division that holds the coordinate; saturates far outside.
int cell_of(double v, double origin, double size) {
    constexpr double limit = 1 << 30;
    const double cell = std::floor((v - origin) / size);
    return cell > -limit ? static_cast<int>(std::min(cell, limit)) : -(1 << 30);
}

/// Returns the distance from a coordinate to an interval, 0 inside.
double gap(double v, double lo, double hi) { return std::max(std::max(lo - v, v - hi), 0.0); }

bool same_row(const PlacedRun& a, const PlacedRun& b) { return a.layer == b.layer && a.row == b.row; }

}  // namespace

Box SurveyGrid::box(const PlacedRun& run) const {
    const double unit = pitch / run_unit;
    return {
        {origin.x + run.begin * unit, origin.y + run.row * pitch, z0 + run.layer * layer_height},
        {origin.x + run.end * unit, origin.y + (run.row + 1) * pitch, z0 + (run.layer + 1) * layer_height}};
}

RunBoxes::RunBoxes(const SurveyGrid& grid, std::vector<PlacedRun> runs) : grid_(grid) {
    std::sort(runs.begin(), runs.end());
    for (const PlacedRun& run : runs) {
        if (!runs_.empty() && same_row(runs_.back(), run) && run.begin <= runs_.back().end) {
            runs_.back().end = std::max(runs_.back().end, run.end);
        } else {
            runs_.push_back(run);
        }
    }
    starts_.push_back(0);
    if (runs_.empty()) return;
    first_layer_ = runs_.front().layer;
    const auto layers = static_cast<std::size_t>(runs_.back().layer - first_layer_) + 1;
    starts_.assign(layers + 1, 0);
    rects_.resize(layers);
    for (const PlacedRun& run : runs_) {
        const auto l = static_cast<std::size_t>(run.layer - first_layer_);
        ++starts_[l + 1];
        const Box box = grid_.box(run);
        rects_[l] = unite(rects_[l], box.rect());
        bounds_ = unite(bounds_, box);
    }
    for (std::size_t l = 0; l < layers; ++l) starts_[l + 1] += starts_[l];
}

std::span<const PlacedRun> RunBoxes::layer(int index) const {
    const auto l = static_cast<std::size_t>(index - first_layer_);
    if (index < first_layer_ || l + 1 >= starts_.size()) return {};
    return std::span(runs_).subspan(starts_[l], starts_[l + 1] - starts_[l]);
}

std::span<const PlacedRun> RunBoxes::row(int layer_index, int row) const {
    const auto all = layer(layer_index);
    const auto [first, last] =
        std::equal_range(all.begin(), all.end(), PlacedRun{layer_index, row, 0, 0},
                         [](const PlacedRun& a, const PlacedRun& b) { return a.row < b.row; });
    return {first, last};
}

std::span<const PlacedRun> RunBoxes::at(double z) const {
    return layer(cell_of(z, grid_.z0, grid_.layer_height));
}

const PlacedRun* RunBoxes::find(dvec3 p) const {
    if (!bounds_.contains(p)) return nullptr;
    const auto runs =
        row(cell_of(p.z, grid_.z0, grid_.layer_height), cell_of(p.y, grid_.origin.y, grid_.pitch));
    const double u = (p.x - grid_.origin.x) * (run_unit / grid_.pitch);
    const auto after = std::upper_bound(runs.begin(), runs.end(), u,
                                        [](double v, const PlacedRun& run) { return v < run.end; });
    return after != runs.end() && after->begin <= u ? &*after : nullptr;
}

double RunBoxes::distance_in_layer(int index, dvec3 p, double limit) const {
    const auto runs = layer(index);
    if (runs.empty()) return limit;
    const double z = grid_.z0 + index * grid_.layer_height, dz = gap(p.z, z, z + grid_.layer_height);
    const Rect& rect = rects_[static_cast<std::size_t>(index - first_layer_)];
    const double x = gap(p.x, rect.lo.x, rect.hi.x), y = gap(p.y, rect.lo.y, rect.hi.y);
    if (dz * dz + x * x + y * y >= limit * limit) return limit;
    // Rows beyond the limit cannot matter; of a row, only the runs on either side of the point.
    const int low = std::max(runs.front().row, cell_of(p.y - limit, grid_.origin.y, grid_.pitch));
    const int high = std::min(runs.back().row, cell_of(p.y + limit, grid_.origin.y, grid_.pitch));
    const double u = (p.x - grid_.origin.x) * (run_unit / grid_.pitch);
    double least = limit * limit;
    for (int r = low; r <= high; ++r) {
        const auto line = row(index, r);
        auto near = std::upper_bound(line.begin(), line.end(), u,
                                     [](double v, const PlacedRun& run) { return v < run.end; });
        if (near != line.begin()) --near;
        for (int k = 0; k < 2 && near != line.end(); ++k, ++near) {
            const double d = distance(grid_.box(*near), p);
            least = std::min(least, d * d);
        }
    }
    return std::sqrt(least);
}

double RunBoxes::distance_within(dvec3 p, double limit) const {
    if (runs_.empty() || !(distance(bounds_, p) < limit)) return limit;
    const int middle = cell_of(p.z, grid_.z0, grid_.layer_height);
    const int last = first_layer_ + static_cast<int>(starts_.size()) - 2;
    const int farthest = std::max(std::abs(middle - first_layer_), std::abs(middle - last));
    for (int k = std::max(0, std::max(first_layer_ - middle, middle - last)); k <= farthest; ++k) {
        if ((k - 1) * grid_.layer_height >= limit) break;
        limit = distance_in_layer(middle - k, p, limit);
        if (k > 0) limit = distance_in_layer(middle + k, p, limit);
    }
    return limit;
}

bool RunBoxes::meets(const Box& box) const {
    const Box part = intersect(bounds_, box);
    if (part.empty()) return false;
    const int top = cell_of(part.hi.z, grid_.z0, grid_.layer_height);
    const int high = cell_of(part.hi.y, grid_.origin.y, grid_.pitch);
    const double unit = grid_.pitch / run_unit;
    for (int l = cell_of(part.lo.z, grid_.z0, grid_.layer_height); l <= top; ++l) {
        if (layer(l).empty()) continue;
        for (int r = cell_of(part.lo.y, grid_.origin.y, grid_.pitch); r <= high; ++r) {
            for (const PlacedRun& run : row(l, r)) {
                if (grid_.origin.x + run.begin * unit <= part.hi.x &&
                    part.lo.x <= grid_.origin.x + run.end * unit)
                    return true;
            }
        }
    }
    return false;
}

}  // namespace lamella
