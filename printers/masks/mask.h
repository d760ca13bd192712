// MaskLayout and mask rendering: turns a layer into the pixels of a display, band by band.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "engine/contours/coverage.h"
#include "engine/layers/layer.h"
#include "printers/common/profile.h"

namespace lamella {

/// The pixel grid of a display over a part. The centre of the part's bounds (x, y) lies at the display's
/// centre.
///
/// ImageProfile::width counts pixels along the plate's x, height along y. Landscape: image columns run along
/// +x and row 0 lies at the largest y, as seen from above. Portrait: columns run along +y and row 0 lies at
/// the largest x, so the image is `height` wide and `width` high. mirror_x then reverses the columns of the
/// image and mirror_y its rows. All of this is done by the direction and sign of the sampled lines; no pixel
/// is moved.
class MaskLayout {
  public:
    /// Throws InputError for an invalid profile, or a part that is larger than the display.
    MaskLayout(const ImageProfile& profile, const Box& part_bounds);

    int width() const { return width_; }    ///< image columns
    int height() const { return height_; }  ///< image rows
    /// Distance between columns and between rows, mm.
    double column_pitch() const { return std::abs(grid_.along_pitch); }
    double row_pitch() const { return std::abs(grid_.across_pitch); }
    /// Returns the lines of rows [first, first + count), `sub` lines per row, over all columns.
    RowBand rows(int first, int count, int sub) const;

  private:
    RowBand grid_;
    int width_;
    int height_;
};

/// Returns the largest size of a part, mm: the display without the margin at its edge.
dvec2 display_area_limits(const ImageProfile& profile);

/// Returns all sampled lines of a layer from which masks are made. Empty if masks also need anything but
/// lines (exact antialiasing, several planes per layer), or if the part is larger than the display. Throws
/// InputError for an invalid profile.
std::optional<RowBand> mask_lines(const ImageProfile& profile, const Box& part_bounds);

/// Receives the runs of the next `rows` rows of an image.
using BandSink = std::function<void(std::span<const GreyRun> runs, int rows)>;

/// Solid areas of a layer, mm^2.
struct MaskArea {
    double part = 0;
    double supports = 0;
};

/// Passes the layer's mask to `sink` band by band, top to bottom, and returns the layer's areas; with several
/// planes per layer the means of their areas. Supports are dimmed to `support_grey` (0 to 1); in a pixel
/// shared with the part the brighter grey counts. Memory: one band.
MaskArea mask_layer(const Layer& layer, const MaskLayout& layout, const ImageProfile& profile,
                    double support_grey, const BandSink& sink);

/// One of the two solids of a layer.
enum class MaskedSolid : unsigned char { part, supports };

/// Passes the mask of one solid to `sink`, without dimming. Supports are rendered only if the layer has some.
/// Returns the solid's area, mm^2.
double mask_solid(const Layer& layer, MaskedSolid which, const MaskLayout& layout,
                  const ImageProfile& profile, const BandSink& sink);

}  // namespace lamella
