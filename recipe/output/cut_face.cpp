// Planes of constant x or y meet each slice in one line; a plane of constant z is a slice.
#include "recipe/output/cut_face.h"

#include <cmath>

#include "engine/base/parallel.h"
#include "engine/field/slice_context.h"

namespace lamella {
namespace {

constexpr int pixels_per_cell = 4;
constexpr int rows_of_a_slice = 64;  // taken from a slice at once, where the plane is one

}  // namespace

CutFace::CutFace(const TwoSolids& solids, const Box& bounds, const PreviewCut& plane, double pitch,
                 const CancelToken* cancel)
    : bounds_(bounds),
      along_(plane.axis == 0 ? 1 : 0),
      across_(plane.axis == 2 ? 1 : 2),
      pitch_(pitch / pixels_per_cell) {
    width_ = std::max(static_cast<int>(std::ceil(bounds.size()[along_] / pitch_)), 1);
    height_ = std::max(static_cast<int>(std::ceil(bounds.size()[across_] / pitch_)), 1);
    const auto area = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    part_.assign(area, 0);
    if (solids.second) all_.assign(area, 0);
    const int together = across_ == 2 ? 1 : rows_of_a_slice;
    parallel_for((height_ + together - 1) / together, [&](int group) {
        stop_if_cancelled(cancel);
        const int first = group * together;
        fill_rows(solids, first, std::min(together, height_ - first), plane);
    });
}

void CutFace::fill_rows(const TwoSolids& solids, int first, int count, const PreviewCut& plane) {
    const double across = bounds_.lo[across_] + first * pitch_;
    if (across + 0.5 * pitch_ > bounds_.hi[across_]) return;
    RowBand band;
    band.axis = along_ == 0 ? Axis::x : Axis::y;
    band.along_origin = bounds_.lo[along_];
    band.along_pitch = pitch_;
    band.across_pitch = pitch_;
    band.across_origin = across_ == 2 ? plane.at - 0.5 * pitch_ : across;
    band.count = count;
    band.hi = width_;
    SliceContext context;
    const Rect bounds = bounds_.rect();
    const double height = across_ == 2 ? across + 0.5 * pitch_ : plane.at;
    PlaneRuns runs;
    runs.cut(solids, context, height, band, bounds);
    store(runs.part(), first, part_);
    if (solids.second) store(runs.all(), first, all_);
}

void CutFace::store(const RunRows& rows, int first, std::vector<std::uint8_t>& shares) const {
    for (std::size_t line = 0; line < rows.lines(); ++line) {
        std::uint8_t* const pixels =
            &shares[(static_cast<std::size_t>(first) + line) * static_cast<std::size_t>(width_)];
        for (const Run& run : rows.line(line)) {
            for (std::int32_t x = run.begin / run_unit; x * run_unit < run.end; ++x) {
                const std::int32_t length =
                    std::min(run.end, (x + 1) * run_unit) - std::max(run.begin, x * run_unit);
                pixels[x] = static_cast<std::uint8_t>(std::min(255, pixels[x] + length));
            }
        }
    }
}

double CutFace::share(const std::vector<std::uint8_t>& shares, dvec2 at) const {
    const dvec2 q = at / pitch_ - 0.5;
    const dvec2 low = glm::floor(q), f = q - low;
    const auto pixel = [&](int x, int y) {
        if (x < 0 || y < 0 || x >= width_ || y >= height_) return 0.0;
        return static_cast<double>(shares[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                          static_cast<std::size_t>(x)]);
    };
    const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
    const double below = pixel(x, y) + (pixel(x + 1, y) - pixel(x, y)) * f.x;
    const double above = pixel(x, y + 1) + (pixel(x + 1, y + 1) - pixel(x, y + 1)) * f.x;
    return below + (above - below) * f.y;
}

CutFace::Kind CutFace::at(dvec3 p) const {
    const dvec2 on(p[along_] - bounds_.lo[along_], p[across_] - bounds_.lo[across_]);
    if (on.x < 0 || on.y < 0 || p[along_] > bounds_.hi[along_] || p[across_] > bounds_.hi[across_])
        return Kind::none;
    if (share(part_, on) > 127.5) return Kind::part;
    return !all_.empty() && share(all_, on) > 127.5 ? Kind::second : Kind::none;
}

}  // namespace lamella
