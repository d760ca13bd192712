// Hanging regions: each region is drawn on a raster of its own and walked along parallel digital lines, which
// meet every pixel once.
#include "engine/checks/hanging_regions.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

/// The states of a pixel: void, beside an outline (neither void nor hanging), supported, hanging.
enum : std::uint8_t { none, beside, hold, hangs };

constexpr int margin = 3;  // pixels around a region, for the supported parts beside it

std::int32_t pixel_of(std::int32_t u) { return u >= 0 ? u / run_unit : -((run_unit - 1 - u) / run_unit); }

/// A region and its surroundings, pixel by pixel.
class RegionRaster {
  public:
    RegionRaster(const std::vector<PlacedRun>& region, const ComponentExtent& extent, const RunRows& held)
        : x0_(pixel_of(extent.along.begin) - margin),
          y0_(extent.first_row - margin),
          width_(pixel_of(extent.along.end - 1) + 1 + margin - x0_),
          height_(extent.last_row + 1 + margin - y0_),
          states_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), none) {
        const int lines = static_cast<int>(held.lines());
        for (int y = std::max(y0_, 0); y < std::min(y0_ + height_, lines); ++y) {
            for (const Run& run : held.line(static_cast<std::size_t>(y))) {
                // A pixel is supported if its centre is.
                fill(y, pixel_of(run.begin + run_unit / 2), pixel_of(run.end + run_unit / 2), hold);
            }
        }
        for (const PlacedRun& run : region) fill_hanging(run);
        mark_beside();
    }

    int width() const { return width_; }
    int height() const { return height_; }
    std::uint8_t at(int x, int y) const { return states_[place(x, y)]; }

  private:
    std::size_t place(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    void fill(int row, std::int32_t from, std::int32_t to, std::uint8_t state) {
        from = std::max(from - x0_, 0);
        to = std::min(to - x0_, width_);
        for (std::int32_t x = from; x < to; ++x) states_[place(x, row - y0_)] = state;
    }
    /// Marks all pixels that a run meets, except supported ones: no part that hangs is lost.
    void fill_hanging(const PlacedRun& run) {
        const std::int32_t from = pixel_of(run.begin) - x0_, to = pixel_of(run.end - 1) + 1 - x0_;
        for (std::int32_t x = from; x < to; ++x) {
            std::uint8_t& state = states_[place(x, run.row - y0_)];
            if (state != hold) state = hangs;
        }
    }
    /// Digital lines along a slanted outline step out of the region and in again. Therefore void pixels next
    /// to hanging ones are marked `beside`. So are hanging pixels next to void, if the region has others
    /// farther in.
    void mark_beside() {
        const std::vector<std::uint8_t> states = states_;
        bool inner = false;
        const auto each = [&](std::uint8_t state, std::uint8_t neighbour, const auto& act) {
            for (int y = 1; y + 1 < height_; ++y) {
                for (int x = 1; x + 1 < width_; ++x) {
                    if (states[place(x, y)] == state) act(x, y, touches(states, neighbour, x, y));
                }
            }
        };
        each(none, hangs, [&](int x, int y, bool touching) {
            if (touching) states_[place(x, y)] = beside;
        });
        each(hangs, none, [&](int, int, bool touching) { inner = inner || !touching; });
        if (!inner) return;
        each(hangs, none, [&](int x, int y, bool touching) {
            if (touching) states_[place(x, y)] = beside;
        });
    }
    bool touches(const std::vector<std::uint8_t>& states, std::uint8_t wanted, int x, int y) const {
        for (int j = y - 1; j <= y + 1; ++j) {
            for (int i = x - 1; i <= x + 1; ++i) {
                if (states[place(i, j)] == wanted) return true;
            }
        }
        return false;
    }

    int x0_, y0_, width_, height_;
    std::vector<std::uint8_t> states_;
};

/// A direction of bridges: `slope` pixels across for each pixel along x, or along y if `steep`.
struct Way {
    double slope;
    bool steep;
};

/// Returns the length of the longest bridge in a direction, pixels; empty if a bridge lacks support at an
/// end.
std::optional<double> longest_way(const RegionRaster& raster, const Way& way) {
    const int length = way.steep ? raster.height() : raster.width(),
              breadth = way.steep ? raster.width() : raster.height();
    std::vector<int> shifts;
    shifts.reserve(static_cast<std::size_t>(length));
    for (int i = 0; i < length; ++i) shifts.push_back(static_cast<int>(std::floor(way.slope * i + 0.5)));
    const int lowest = std::min(shifts.front(), shifts.back()),
              highest = std::max(shifts.front(), shifts.back());
    int longest = 0;
    for (int line = -highest; line < breadth - lowest; ++line) {
        int last_hold = -1;  // last supported pixel; -1 if void followed
        bool hanging = false;
        for (int i = 0; i < length; ++i) {
            const int j = line + shifts[static_cast<std::size_t>(i)];
            const bool inside = j >= 0 && j < breadth;
            const std::uint8_t state = !inside     ? std::uint8_t{none}
                                       : way.steep ? raster.at(j, i)
                                                   : raster.at(i, j);
            if (state == hangs) {
                if (last_hold < 0) return std::nullopt;
                hanging = true;
            } else if (state == hold) {
                if (hanging) longest = std::max(longest, i - last_hold - 1);
                last_hold = i;
                hanging = false;
            } else if (state == none) {
                if (hanging) return std::nullopt;
                last_hold = -1;
            }
        }
        if (hanging) return std::nullopt;
    }
    return longest * std::sqrt(1 + way.slope * way.slope);
}

/// Returns the direction in which a region is longest: the major axis of its second moments.
Way axis_of(const std::vector<PlacedRun>& region) {
    double weight = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    for (const PlacedRun& run : region) {
        const double w = (static_cast<double>(run.end) - run.begin) / run_unit,
                     middle = 0.5 * (static_cast<double>(run.begin) + run.end) / run_unit;
        weight += w;
        x += w * middle;
        y += w * run.row;
        xx += w * (middle * middle + w * w / 12);
        yy += w * (static_cast<double>(run.row) * run.row);
        xy += w * middle * run.row;
    }
    const double cxx = xx / weight - x / weight * (x / weight), cyy = yy / weight - y / weight * (y / weight),
                 cxy = xy / weight - x / weight * (y / weight), d = cxx - cyy,
                 h = std::sqrt(d * d + 4 * cxy * cxy);
    if (h == 0) return {0, false};
    return d >= 0 ? Way{2 * cxy / (d + h), false} : Way{2 * cxy / (h - d), true};
}

std::optional<double> bridge_of(const RegionRaster& raster, const std::vector<PlacedRun>& region) {
    const Way axis = axis_of(region);
    std::vector<Way> ways{axis, {-axis.slope, !axis.steep}};  // and at right angles to it
    for (const double slope : {0.0, 0.25, -0.25, 0.5, -0.5, 0.75, -0.75, 1.0}) {
        ways.push_back({slope, false});
        ways.push_back({slope == 1 ? -1 : slope, slope < 1});
    }
    std::optional<double> least;
    for (const Way& way : ways) {
        const std::optional<double> longest = longest_way(raster, way);
        if (longest && (!least || *longest < *least)) least = longest;
    }
    return least;
}

}  // namespace

std::vector<std::uint8_t> reaching(const LabelledLayer& labelled, double least, const CheckGrid& grid) {
    std::vector<std::uint8_t> reach;
    for (const ComponentExtent& extent : labelled.components) {
        const dvec3 size = grid.box(extent).size();
        reach.push_back(size.x * size.x + size.y * size.y >= least * least);
    }
    return reach;
}

std::vector<HangingRegion> find_hanging_regions(const RunRows& hanging, const RunRows& held, double least,
                                                int layer, const CheckGrid& grid) {
    const LabelledLayer labelled = label_layer(hanging, layer, Growth{});
    const std::vector<std::uint8_t> large = reaching(labelled, least, grid);
    std::vector<std::vector<PlacedRun>> runs(labelled.components.size());
    for (int r = 0; r < labelled.rows(); ++r) {
        for (const LabelledRun& run : labelled.row(r)) {
            if (large[run.component] != 0) runs[run.component].push_back({layer, r, run.begin, run.end});
        }
    }
    std::vector<HangingRegion> regions;
    for (std::size_t c = 0; c < runs.size(); ++c) {
        if (large[c] == 0) continue;
        HangingRegion region;
        const RegionRaster raster(runs[c], labelled.components[c], held);
        if (const auto pixels = bridge_of(raster, runs[c])) region.bridge = *pixels * grid.band.along_pitch;
        region.runs = std::move(runs[c]);
        regions.push_back(std::move(region));
    }
    return regions;
}

}  // namespace lamella
