// Pictures of layers: a solid cut into planes, as pixels, for walks that look at every place a printer comes
// by.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/engine/runs/plane_runs.h"

namespace lamella {

/// A pixel's place in a picture.
struct PixelPlace {
    int x = 0;
    int y = 0;
};

/// A layer as pixels; a pixel is set where its middle is solid.
class LayerPicture {
  public:
    LayerPicture() = default;
    LayerPicture(int width, int height)
        : width_(width),
          height_(height),
          pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0) {}

    int width() const { return width_; }
    int height() const { return height_; }
    /// False beyond the border.
    bool at(int x, int y) const {
        return x >= 0 && y >= 0 && x < width_ && y < height_ && pixels_[number(x, y)] != 0;
    }
    bool at(PixelPlace p) const { return at(p.x, p.y); }
    void set(int x, int y, bool solid) { pixels_[number(x, y)] = solid ? 1 : 0; }
    std::size_t number(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    std::size_t count() const {
        std::size_t set = 0;
        for (const std::uint8_t pixel : pixels_) set += pixel;
        return set;
    }
    /// Calls visit(x, y) for every pixel that is set, row by row.
    template <typename Visit>
    void visit(const Visit& visit) const {
        for (int y = 0; y < height_; ++y) {
            for (int x = 0; x < width_; ++x) {
                if (at(x, y)) visit(x, y);
            }
        }
    }

  private:
    int width_ = 0, height_ = 0;
    std::vector<std::uint8_t> pixels_;
};

/// Where the pixels of a stack of layers lie; lengths in mm.
struct LayerGrid {
    LayerGrid(const Box& box, double bed_height, double height_of_layer, double pixel_side)
        : band(band_over(box, pixel_side)),
          pixel(pixel_side),
          bed(bed_height),
          layer_height(height_of_layer),
          layers(static_cast<int>(std::ceil((box.hi.z - bed_height) / height_of_layer - 1e-6))) {}

    RowBand band;
    double pixel, bed, layer_height;
    int layers;

    /// The plane at which a layer is cut: its middle.
    double plane(int layer) const { return bed + (layer + 0.5) * layer_height; }
    /// The middle of a pixel.
    dvec3 place(int x, int y, double z) const {
        return {band.along_origin + (x + 0.5) * pixel, band.across_origin + (y + 0.5) * pixel, z};
    }
    /// Half the way across a pixel: as far as a solid's border lies from the nearest middle, unless it is
    /// thin.
    double blur() const { return 0.71 * pixel; }
    /// Whether a pixel is set whose middle lies within `reach` mm of that of (x, y).
    bool near(const LayerPicture& picture, int x, int y, double reach) const {
        if (picture.at(x, y)) return true;
        const double most = reach / pixel + 1e-9;
        const int r = static_cast<int>(most);
        for (int j = -r; j <= r; ++j) {
            for (int i = -r; i <= r; ++i) {
                if (i * i + j * j <= most * most && picture.at(x + i, y + j)) return true;
            }
        }
        return false;
    }
};

inline LayerPicture picture_of(const Field& field, double z, const RowBand& band) {
    LayerPicture picture(band.hi, band.count);
    const RunRows rows = runs_at(field, z, band);
    for (int y = 0; y < band.count; ++y) {
        for (const Run& run : rows.line(static_cast<std::size_t>(y))) {
            // The first pixel whose middle is not before the run's begin.
            for (int x = (run.begin + run_unit / 2 - 1) / run_unit; x * run_unit + run_unit / 2 < run.end;
                 ++x) {
                picture.set(x, y, true);
            }
        }
    }
    return picture;
}

/// All layers of a grid, from the bed on.
inline std::vector<LayerPicture> pictures_of(const Field& field, const LayerGrid& grid) {
    std::vector<LayerPicture> pictures;
    for (int i = 0; i < grid.layers; ++i) {
        pictures.push_back(picture_of(field, grid.plane(i), grid.band));
    }
    return pictures;
}

}  // namespace lamella
