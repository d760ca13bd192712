// How a layer becomes the pixels of a display: placement, mirroring, and bands of grey runs.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "engine/contours/coverage.h"
#include "engine/layers/layer.h"
#include "printers/common/profile.h"

namespace lamella {

/// The grid of pixels that a display lays over a part. The centre of the part's bounds (x, y) lies at the
/// display's centre.
///
/// ImageProfile::width counts pixels along the plate's x, height along y. Landscape: image columns run along
/// +x and row 0 lies at the largest y, as seen from above. Portrait: columns run along +y and row 0 lies at
/// the largest x, so the image is `height` wide and `width` high. mirror_x then reverses the columns of the
/// image and mirror_y its rows. All of it is the direction and sign of the lines asked for; no pixel is
/// moved.
class MaskLayout {
  public:
    /// Throws InputError for a profile that makes no sense, or a part that is larger than the display.
    MaskLayout(const ImageProfile& profile, const Box& part_bounds);

    int width() const { return width_; }    ///< image columns
    int height() const { return height_; }  ///< image rows
    /// Pitch of columns and rows, mm.
    double column_pitch() const { return std::abs(grid_.along_pitch); }
    double row_pitch() const { return std::abs(grid_.across_pitch); }
    /// Rows [first, first + count) with `sub` lines each, all columns.
    RowBand rows(int first, int count, int sub) const;

  private:
    RowBand grid_;
    int width_;
    int height_;
};

/// What a display has room for, mm: all of it but the margin at its edge.
dvec2 display_area_limits(const ImageProfile& profile);

/// All lines of a layer that masks are made of. None where they look at other things as well, or where the
/// part is larger than the display. Throws InputError for a profile that makes no sense.
std::optional<RowBand> mask_lines(const ImageProfile& profile, const Box& part_bounds);

/// Takes the runs of the next `rows` rows of an image.
using BandSink = std::function<void(std::span<const GreyRun> runs, int rows)>;

/// Solid areas of a layer, mm^2.
struct MaskArea {
    double part = 0;
    double supports = 0;
};

/// Hands the layer's mask to `sink` band by band, top to bottom, and returns the layer's areas: with several
/// planes a layer their means. Supports are dimmed to `support_grey` (0 to 1); where they share a pixel with
/// the part the brighter one counts. Memory: one band.
MaskArea mask_layer(const Layer& layer, const MaskLayout& layout, const ImageProfile& profile,
                    double support_grey, const BandSink& sink);

/// One of the two solids of a layer.
enum class MaskedSolid : unsigned char { part, supports };

/// The same for one solid alone, not dimmed; the supports only where the layer has some. Returns its area,
/// mm^2.
double mask_solid(const Layer& layer, MaskedSolid which, const MaskLayout& layout,
                  const ImageProfile& profile, const BandSink& sink);

}  // namespace lamella
