// Rows of sections, and halving between the outermost ones.
#include "recipe/pieces/section_bounds.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/field/slice_context.h"
#include "engine/runs/row_sets.h"

namespace lamella {

namespace {

constexpr int section_count = 200, rows_across = 1000;
constexpr double precision = 0.001;  // mm

class Sections {
  public:
    explicit Sections(const Field& solid) : solid_(solid), box_(solid.bounds()) {
        const dvec3 size = box_.size();
        pitch_ = std::max(size.x, size.y) / rows_across;
        band_.along_pitch = band_.across_pitch = pitch_;
        band_.along_origin = box_.lo.x;
        band_.across_origin = box_.lo.y;
        band_.hi = static_cast<int>(std::ceil(size.x / pitch_)) + 1;
        band_.count = static_cast<int>(std::ceil(size.y / pitch_)) + 1;
    }

    double pitch() const { return pitch_; }

    /// Returns what the section covers, mm; empty for an empty section.
    Rect at(double z) {
        SliceContext context;
        RunRows rows;
        context.slice(solid_, z).runs(band_, scratch_, rows);
        const std::size_t first = rows.line_with_runs(0);
        if (first == rows.lines()) return {};
        std::size_t last = first;
        for (std::size_t l = first; l < rows.lines(); l = rows.line_with_runs(l + 1)) last = l;
        const Run along = extent_of(rows);
        return {box_.rect().lo +
                    dvec2(along.begin * pitch_ / run_unit, band_.line(static_cast<int>(first)) - box_.lo.y),
                box_.rect().lo +
                    dvec2(along.end * pitch_ / run_unit, band_.line(static_cast<int>(last)) - box_.lo.y)};
    }

    /// Returns the height between one with an empty section and one with a full one where sections begin.
    double border(double empty, double full) {
        while (std::abs(full - empty) > precision) {
            const double middle = (empty + full) / 2;
            (at(middle).empty() ? empty : full) = middle;
        }
        return empty;
    }

  private:
    const Field& solid_;
    Box box_;
    double pitch_;
    RowBand band_;
    Scratch scratch_;
};

/// Returns a side that was found, or that of the box where it comes as near as `within`.
double side(double found, double box, double within) { return std::abs(found - box) <= within ? box : found; }

/// Returns what the sections cover, and as much beyond each side as the outermost section there stands out
/// over its neighbours: an edge between two sections may reach that far.
Rect reached(const std::vector<Rect>& rects) {
    Rect all;
    for (std::size_t i = 0; i < rects.size(); ++i) {
        if (rects[i].empty()) continue;
        Rect rect = rects[i];
        for (const std::size_t other : {i - 1, i + 1}) {
            if (other >= rects.size() || rects[other].empty()) continue;
            rect.lo = glm::min(rect.lo, 2.0 * rects[i].lo - rects[other].lo);
            rect.hi = glm::max(rect.hi, 2.0 * rects[i].hi - rects[other].hi);
        }
        all = unite(all, rect);
    }
    return all;
}

}  // namespace

Box section_bounds(const Field& solid) {
    const Box box = solid.bounds();
    const double apart = box.size().z / section_count;
    const auto height = [&](int i) { return box.lo.z + (i + 0.5) * apart; };
    Sections all(solid);
    std::vector<Rect> rects;
    rects.reserve(section_count);
    for (int i = 0; i < section_count; ++i) rects.push_back(all.at(height(i)));
    const auto has = [](const Rect& rect) { return !rect.empty(); };
    const auto begin = std::ranges::find_if(rects, has);
    if (begin == rects.end()) return {};
    const int first = static_cast<int>(begin - rects.begin());
    const int last = section_count - 1 -
                     static_cast<int>(std::find_if(rects.rbegin(), rects.rend(), has) - rects.rbegin());
    const double low = all.border(first == 0 ? box.lo.z : height(first - 1), height(first));
    const double high = all.border(last == section_count - 1 ? box.hi.z : height(last + 1), height(last));
    const Rect reach = grown(reached(rects), all.pitch());
    Box found{dvec3(reach.lo, low), dvec3(reach.hi, high)};
    for (int axis = 0; axis < 3; ++axis) {
        const double near = axis == 2 ? 20 * precision : 2 * all.pitch();
        found.lo[axis] = side(std::max(found.lo[axis], box.lo[axis]), box.lo[axis], near);
        found.hi[axis] = side(std::min(found.hi[axis], box.hi[axis]), box.hi[axis], near);
    }
    return found;
}

}  // namespace lamella
