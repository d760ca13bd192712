// Placement of a display over a part, and the walk over its bands.
#include "printers/mask.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "printers/png_writer.h"

namespace lamella {
namespace {

void check_profile(const ImageProfile& profile) {
    const auto side = [](const char* key, int pixels) {
        if (pixels < 1 || pixels > 65535) {
            throw InputError(fmt::format("{} = {} px: must be 1 to 65535", key, pixels));
        }
    };
    side("width", profile.width);
    side("height", profile.height);
    const auto pitch = [](const char* key, double mm) {
        if (!(mm >= 1e-4 && mm <= 100)) {
            throw InputError(fmt::format("{} = {} mm: must be 0.0001 to 100", key, mm));
        }
    };
    pitch("pixel_x", profile.pixel_x);
    pitch("pixel_y", profile.pixel_y);
    if (profile.sub_rows < 1 || profile.sub_rows > 64) {
        throw InputError(fmt::format("sub_rows = {}: must be 1 to 64", profile.sub_rows));
    }
}

/// Grid lines 0..count of one direction: where line 0 lies and the signed step, centred at `center`.
struct Steps {
    double origin;
    double pitch;
};
Steps steps(double center, int count, double pitch, bool backwards) {
    const double half = count * pitch / 2;
    return backwards ? Steps{center + half, -pitch} : Steps{center - half, pitch};
}

/// The rows whose lines can meet [lo, hi] across, as [first, last).
struct RowSpan {
    int first;
    int last;
};
RowSpan rows_meeting(const RowBand& grid, double lo, double hi, int height) {
    const double a = (lo - grid.across_origin) / grid.across_pitch;
    const double b = (hi - grid.across_origin) / grid.across_pitch;
    const auto clamped = [&](double row) {
        return static_cast<int>(std::clamp(row, 0.0, static_cast<double>(height)));
    };
    return {clamped(std::floor(std::min(a, b)) - 1), clamped(std::ceil(std::max(a, b)) + 1)};
}

}  // namespace

MaskLayout::MaskLayout(const ImageProfile& profile, const Box& part_bounds) {
    check_profile(profile);
    const double size_x = profile.width * profile.pixel_x;
    const double size_y = profile.height * profile.pixel_y;
    const dvec3 size = part_bounds.size();
    // A part as large as the display fits, whatever the rounding of its bounds.
    constexpr double slack = 1e-9;
    if (size.x > size_x * (1 + slack) || size.y > size_y * (1 + slack)) {
        throw InputError(
            fmt::format("the part is {:.3f} x {:.3f} mm but the display is {:.3f} x {:.3f} mm ({} x {} px); "
                        "scale or turn the part, or choose a larger printer",
                        size.x, size.y, size_x, size_y, profile.width, profile.height));
    }
    const dvec3 center = part_bounds.center();
    const bool flip = profile.mirror_x;
    const bool down = !profile.mirror_y;  // row 0 lies at the largest coordinate
    Steps columns{};
    Steps rows{};
    if (profile.portrait) {
        grid_.axis = Axis::y;
        width_ = profile.height;
        height_ = profile.width;
        columns = steps(center.y, profile.height, profile.pixel_y, flip);
        rows = steps(center.x, profile.width, profile.pixel_x, down);
    } else {
        grid_.axis = Axis::x;
        width_ = profile.width;
        height_ = profile.height;
        columns = steps(center.x, profile.width, profile.pixel_x, flip);
        rows = steps(center.y, profile.height, profile.pixel_y, down);
    }
    grid_.along_origin = columns.origin;
    grid_.along_pitch = columns.pitch;
    grid_.across_origin = rows.origin;
    grid_.across_pitch = rows.pitch;
    grid_.lo = 0;
    grid_.hi = width_;
}

RowBand MaskLayout::rows(int first, int count, int sub) const {
    RowBand band = grid_;
    band.first = first;
    band.count = count;
    band.sub = sub;
    return band;
}

double mask_layer(const Layer& layer, const MaskLayout& layout, const ImageProfile& profile,
                  const BandSink& sink) {
    const bool exact = profile.antialiasing == Antialiasing::exact;
    const int sub = profile.antialiasing == Antialiasing::rows ? profile.sub_rows : 1;
    const Rect solid = layer.part().bounds();
    const RowBand grid = layout.rows(0, 0, 1);
    RowSpan meets{0, 0};
    if (!solid.empty()) {
        meets = grid.axis == Axis::x ? rows_meeting(grid, solid.lo.y, solid.hi.y, layout.height())
                                     : rows_meeting(grid, solid.lo.x, solid.hi.x, layout.height());
    }
    SpanRows spans;
    Scratch scratch;
    std::vector<GreyRun> runs;
    double pixels = 0;
    for (int row = 0; row < layout.height(); row += png_band_rows) {
        const int count = std::min(png_band_rows, layout.height() - row);
        runs.clear();
        if (row >= meets.last || row + count <= meets.first) {
            runs.assign(static_cast<std::size_t>(count), {static_cast<std::uint32_t>(layout.width()), 0});
        } else if (exact) {
            coverage_exact(layer.part(), layout.rows(row, count, 1), scratch, runs);
            for (const GreyRun& run : runs) pixels += run.length * (run.value / 255.0);
        } else {
            const RowBand band = layout.rows(row, count, sub);
            spans.clear();
            layer.spans(band, spans);
            if (profile.antialiasing == Antialiasing::off) {
                threshold(band, spans, runs);
            } else {
                coverage(band, spans, runs);
            }
            pixels += static_cast<double>(spans.total_length()) / (run_unit * sub);
        }
        sink(runs, count);
    }
    return pixels * layout.column_pitch() * layout.row_pitch();
}

}  // namespace lamella
