// Placement of a display over a part, and the walk over its bands.
#include "printers/mask.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

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

/// The grey runs of one slice, rows at a time from the top.
class SliceMask {
  public:
    SliceMask(const SliceField& slice, const MaskLayout& layout, const ImageProfile& profile)
        : slice_(slice), layout_(layout), antialiasing_(profile.antialiasing) {
        if (antialiasing_ == Antialiasing::rows) sub_ = profile.sub_rows;
        const Rect solid = slice.bounds();
        if (solid.empty()) return;
        const RowBand grid = layout.rows(0, 0, 1);
        rows_ = grid.axis == Axis::x ? rows_meeting(grid, solid.lo.y, solid.hi.y, layout.height())
                                     : rows_meeting(grid, solid.lo.x, solid.hi.x, layout.height());
    }

    bool meets(int row, int count) const { return row < rows_.last && row + count > rows_.first; }

    /// Appends the runs of rows [row, row + count).
    void add_rows(int row, int count, std::vector<GreyRun>& runs) {
        if (!meets(row, count)) {
            runs.insert(runs.end(), static_cast<std::size_t>(count),
                        {static_cast<std::uint32_t>(layout_.width()), 0});
        } else if (antialiasing_ == Antialiasing::exact) {
            const std::size_t first = runs.size();
            coverage_exact(slice_, layout_.rows(row, count, 1), scratch_, runs);
            for (std::size_t i = first; i < runs.size(); ++i)
                pixels_ += runs[i].length * (runs[i].value / 255.0);
        } else {
            const RowBand band = layout_.rows(row, count, sub_);
            spans_.clear();
            slice_.spans(band, scratch_, spans_);
            if (antialiasing_ == Antialiasing::off) {
                threshold(band, spans_, runs);
            } else {
                coverage(band, spans_, runs);
            }
            pixels_ += static_cast<double>(spans_.total_length()) / (run_unit * sub_);
        }
    }

    double pixels() const { return pixels_; }  ///< covered so far

  private:
    const SliceField& slice_;
    const MaskLayout& layout_;
    Antialiasing antialiasing_;
    int sub_ = 1;
    RowSpan rows_{0, 0};
    Scratch scratch_;
    SpanRows spans_;
    double pixels_ = 0;
};

/// Grey values times a share of 0 to 1.
std::array<std::uint8_t, 256> dimming(double share) {
    std::array<std::uint8_t, 256> dimmed{};
    for (std::size_t value = 0; value < dimmed.size(); ++value)
        dimmed[value] = static_cast<std::uint8_t>(std::floor(static_cast<double>(value) * share + 0.5));
    return dimmed;
}

/// Appends, pixel by pixel, the brighter of two images of the same rows.
void brighter(const std::vector<GreyRun>& a, const std::vector<GreyRun>& b, int width,
              std::vector<GreyRun>& out) {
    std::uint32_t left_a = 0;
    std::uint32_t left_b = 0;
    std::uint32_t column = 0;
    for (std::size_t i = 0, j = 0; i < a.size();) {
        if (left_a == 0) left_a = a[i].length;
        if (left_b == 0) left_b = b[j].length;
        const std::uint32_t length = std::min(left_a, left_b);
        const std::uint8_t value = std::max(a[i].value, b[j].value);
        if (column > 0 && out.back().value == value) {
            out.back().length += length;
        } else {
            out.push_back({length, value});
        }
        column = column + length == static_cast<std::uint32_t>(width) ? 0 : column + length;
        if ((left_a -= length) == 0) ++i;
        if ((left_b -= length) == 0) ++j;
    }
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

MaskArea mask_layer(const Layer& layer, const MaskLayout& layout, const ImageProfile& profile,
                    double support_grey, const BandSink& sink) {
    SliceMask part(layer.part(), layout, profile);
    std::optional<SliceMask> supports;
    if (layer.supports() != nullptr) supports.emplace(*layer.supports(), layout, profile);
    const std::array<std::uint8_t, 256> dimmed = dimming(support_grey);
    std::vector<GreyRun> runs;
    std::vector<GreyRun> below;
    std::vector<GreyRun> merged;
    for (int row = 0; row < layout.height(); row += png_band_rows) {
        const int count = std::min(png_band_rows, layout.height() - row);
        runs.clear();
        part.add_rows(row, count, runs);
        if (supports && supports->meets(row, count)) {
            below.clear();
            supports->add_rows(row, count, below);
            for (GreyRun& run : below) run.value = dimmed[run.value];
            merged.clear();
            brighter(runs, below, layout.width(), merged);
            std::swap(runs, merged);
        }
        sink(runs, count);
    }
    const double pixel = layout.column_pitch() * layout.row_pitch();
    return {part.pixels() * pixel, supports ? supports->pixels() * pixel : 0};
}

}  // namespace lamella
