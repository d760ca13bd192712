// Places a display over a part and renders its masks band by band.
#include "printers/masks/mask.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/base/error.h"
#include "printers/masks/grey_rows.h"
#include "printers/masks/png_writer.h"

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
    if (profile.sub_layers < 1 || profile.sub_layers > 64) {
        throw InputError(fmt::format("sub_layers = {}: must be 1 to 64", profile.sub_layers));
    }
    if (profile.sub_layers > 1 && profile.antialiasing == Antialiasing::off) {
        throw InputError(
            fmt::format("sub_layers = {} makes grey pixels, which antialiasing = \"off\" rules "
                        "out; accepted: antialiasing = \"rows\" or \"exact\"",
                        profile.sub_layers));
    }
    if (profile.bits != 1 && profile.bits != 8 && profile.bits != 16) {
        throw InputError(fmt::format("bits = {}: must be 1, 8 or 16", profile.bits));
    }
    if (profile.bits == 1 && profile.antialiasing != Antialiasing::off) {
        throw InputError("bits = 1 has no room for grey pixels; accepted: antialiasing = \"off\"");
    }
    if (!(profile.gamma >= 0.1 && profile.gamma <= 10)) {
        throw InputError(fmt::format("gamma = {}: must be 0.1 to 10", profile.gamma));
    }
    if (!(profile.min_grey >= 0 && profile.min_grey <= profile.full_grey && profile.full_grey <= 1)) {
        throw InputError(
            fmt::format("least_grey = {}, full_grey = {}: must be 0 <= least_grey <= full_grey <= 1",
                        profile.min_grey, profile.full_grey));
    }
    if (!(profile.margin >= 0)) {
        throw InputError(fmt::format("display_margin = {} mm: must be 0 or more", profile.margin));
    }
}

/// Grid lines 0..count along one axis, centred at `center`: position of line 0 and signed step.
struct Steps {
    double origin;
    double pitch;
};
Steps steps(double center, int count, double pitch, bool backwards) {
    const double half = count * pitch / 2;
    return backwards ? Steps{center + half, -pitch} : Steps{center - half, pitch};
}

/// The rows [first, last) whose lines can meet [lo, hi] in the direction across the rows.
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

/// Returns the number of sampled lines per pixel row.
int lines_a_row(const ImageProfile& profile) {
    return profile.antialiasing == Antialiasing::rows ? profile.sub_rows : 1;
}

/// Renders the grey runs of one slice, from the top row down.
class SliceMask {
  public:
    SliceMask(const SliceField& slice, const MaskLayout& layout, const ImageProfile& profile,
              std::span<LineCache> kept)
        : slice_(&slice),
          layout_(&layout),
          antialiasing_(profile.antialiasing),
          sub_(lines_a_row(profile)),
          kept_(kept) {
        white_ = white_of(profile);
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
                        {static_cast<std::uint32_t>(layout_->width()), 0});
        } else if (antialiasing_ == Antialiasing::exact) {
            const std::size_t first = runs.size();
            coverage_exact(*slice_, layout_->rows(row, count, 1), scratch_, runs, white_);
            for (std::size_t i = first; i < runs.size(); ++i)
                pixels_ += runs[i].length * (runs[i].value / static_cast<double>(white_));
        } else {
            const RowBand band = layout_->rows(row, count, sub_);
            spans_.clear();
            slice_->runs(band, scratch_, spans_);
            for (LineCache& lines : kept_) lines.add(band, spans_);
            if (antialiasing_ == Antialiasing::off) {
                threshold(band, spans_, runs, white_);
            } else {
                coverage(band, spans_, runs, white_);
            }
            pixels_ += static_cast<double>(spans_.total_length()) / (run_unit * sub_);
        }
    }

    /// Call when all rows that are not empty have been added.
    void finish() {
        if (antialiasing_ == Antialiasing::exact) return;
        for (LineCache& lines : kept_) lines.finish(layout_->rows(0, 0, sub_));
    }

    double pixels() const { return pixels_; }  ///< covered area so far, pixels

  private:
    const SliceField* slice_;
    const MaskLayout* layout_;
    Antialiasing antialiasing_;
    int sub_;
    std::span<LineCache> kept_;
    int white_ = white_of_8_bits;
    RowSpan rows_{0, 0};
    Scratch scratch_;
    RunRows spans_;
    double pixels_ = 0;
};

/// A run of pixels with the same sum of greys over several planes.
struct GreySum {
    std::uint32_t length;
    std::uint32_t value;
};

/// Renders the mean of a solid's masks on several planes, from the top row down.
class SolidMask {
  public:
    SolidMask(const Layer& layer, const std::vector<const SliceField*>& planes, const MaskLayout& layout,
              const ImageProfile& profile)
        : width_(layout.width()) {
        for (const SliceField* plane : planes)
            planes_.emplace_back(*plane, layout, profile, layer.lines_to_cache(*plane));
    }

    bool meets(int row, int count) const {
        return std::any_of(planes_.begin(), planes_.end(),
                           [&](const SliceMask& plane) { return plane.meets(row, count); });
    }

    /// Appends the runs of rows [row, row + count).
    void add_rows(int row, int count, std::vector<GreyRun>& runs) {
        if (planes_.size() == 1 || !meets(row, count)) {
            planes_.front().add_rows(row, count, runs);
            return;
        }
        sums_.clear();
        for (SliceMask& plane : planes_) {
            image_.clear();
            plane.add_rows(row, count, image_);
            if (sums_.empty()) {
                for (const GreyRun& run : image_) sums_.push_back({run.length, run.value});
                continue;
            }
            next_sums_.clear();
            combine_rows(
                sums_, image_, [](std::uint32_t sum, std::uint16_t grey) { return sum + grey; },
                [&](std::uint32_t length, std::uint32_t sum) {
                    next_sums_.push_back({length, sum});
                });
            std::swap(sums_, next_sums_);
        }
        const auto n = static_cast<std::uint32_t>(planes_.size());
        RowJoiner out(runs, width_);
        for (const GreySum& run : sums_) {
            out.push(run.length, static_cast<std::uint16_t>((run.value + n / 2) / n));
        }
    }

    /// Call when all rows that are not empty have been added.
    void finish() {
        for (SliceMask& plane : planes_) plane.finish();
    }

    /// Returns the covered area so far, pixels: the mean of the planes.
    double pixels() const {
        double sum = 0;
        for (const SliceMask& plane : planes_) sum += plane.pixels();
        return sum / static_cast<double>(planes_.size());
    }

  private:
    int width_;
    std::vector<SliceMask> planes_;
    std::vector<GreyRun> image_;
    std::vector<GreySum> sums_, next_sums_;
};

/// Returns the heights of the averaged planes within a layer, as fractions of the layer height.
std::vector<double> shares_of(const ImageProfile& profile) {
    std::vector<double> shares;
    shares.reserve(static_cast<std::size_t>(profile.sub_layers));
    for (int k = 0; k < profile.sub_layers; ++k) shares.push_back((k + 0.5) / profile.sub_layers);
    return shares;
}

/// Returns the solid's slices in the planes whose masks are averaged; empty if there are no supports.
std::vector<const SliceField*> planes_of(const Layer& layer, MaskedSolid which, const ImageProfile& profile) {
    const bool part = which == MaskedSolid::part;
    std::vector<const SliceField*> planes;
    if (!part && layer.supports() == nullptr) return planes;
    // With one plane use the layer's own slice, which contours and checks also use, not an equal copy.
    if (profile.sub_layers == 1) return {part ? &layer.part() : layer.supports()};
    for (const double share : shares_of(profile))
        planes.push_back(part ? &layer.part_at(share) : layer.supports_at(share));
    return planes;
}

}  // namespace

dvec2 display_area_limits(const ImageProfile& profile) {
    return dvec2(profile.width * profile.pixel_x, profile.height * profile.pixel_y) - 2 * profile.margin;
}

MaskLayout::MaskLayout(const ImageProfile& profile, const Box& part_bounds) {
    check_profile(profile);
    const dvec2 available = display_area_limits(profile);
    const dvec3 size = part_bounds.size();
    // A part as large as the display must fit in spite of rounding.
    constexpr double slack = 1e-9;
    if (size.x > available.x * (1 + slack) || size.y > available.y * (1 + slack)) {
        throw InputError(fmt::format(
            "the part is {:.3f} x {:.3f} mm but the display {} {:.3f} x {:.3f} mm ({} x {} px{}); "
            "scale or turn the part, or choose a larger printer",
            size.x, size.y, profile.margin > 0 ? "has room for" : "is", std::max(available.x, 0.0),
            std::max(available.y, 0.0), profile.width, profile.height,
            profile.margin > 0 ? fmt::format(", {} mm kept clear at its edge", profile.margin)
                               : std::string()));
    }
    const dvec3 center = part_bounds.center();
    const bool flip = profile.mirror_x;
    const bool down = !profile.mirror_y;  // then row 0 is at the largest coordinate
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

std::optional<RowBand> mask_lines(const ImageProfile& profile, const Box& part_bounds) {
    const dvec2 available = display_area_limits(profile);
    const dvec3 size = part_bounds.size();
    const bool reads_lines = profile.antialiasing != Antialiasing::exact && profile.sub_layers == 1;
    if (!reads_lines || size.x > available.x || size.y > available.y) return {};
    const MaskLayout layout(profile, part_bounds);
    return layout.rows(0, layout.height(), lines_a_row(profile));
}

MaskArea mask_layer(const Layer& layer, const MaskLayout& layout, const ImageProfile& profile,
                    double support_grey, const BandSink& sink) {
    SolidMask part(layer, planes_of(layer, MaskedSolid::part, profile), layout, profile);
    const auto support_planes = planes_of(layer, MaskedSolid::supports, profile);
    std::optional<SolidMask> supports;
    if (!support_planes.empty()) supports.emplace(layer, support_planes, layout, profile);
    const GreyTable of_part = grey_table(profile, 1), of_supports = grey_table(profile, support_grey);
    std::vector<GreyRun> runs, below, spare;
    for (int row = 0; row < layout.height(); row += png_band_rows) {
        const int count = std::min(png_band_rows, layout.height() - row);
        runs.clear();
        part.add_rows(row, count, runs);
        apply(of_part, layout.width(), runs, spare);
        if (supports && supports->meets(row, count)) {
            below.clear();
            supports->add_rows(row, count, below);
            apply(of_supports, layout.width(), below, spare);
            spare.clear();
            RowJoiner out(spare, layout.width());
            combine_rows(
                runs, below, [](std::uint16_t a, std::uint16_t b) { return std::max(a, b); },
                [&](std::uint32_t length, std::uint16_t value) { out.push(length, value); });
            std::swap(runs, spare);
        }
        sink(runs, count);
    }
    part.finish();
    if (supports) supports->finish();
    const double pixel = layout.column_pitch() * layout.row_pitch();
    return {part.pixels() * pixel, supports ? supports->pixels() * pixel : 0};
}

double mask_solid(const Layer& layer, MaskedSolid which, const MaskLayout& layout,
                  const ImageProfile& profile, const BandSink& sink) {
    SolidMask solid(layer, planes_of(layer, which, profile), layout, profile);
    const GreyTable greys = grey_table(profile, 1);
    std::vector<GreyRun> runs, spare;
    for (int row = 0; row < layout.height(); row += png_band_rows) {
        const int count = std::min(png_band_rows, layout.height() - row);
        runs.clear();
        solid.add_rows(row, count, runs);
        apply(greys, layout.width(), runs, spare);
        sink(runs, count);
    }
    solid.finish();
    return solid.pixels() * layout.column_pitch() * layout.row_pitch();
}

}  // namespace lamella
