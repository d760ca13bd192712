// Maps coordinates into the cube first; neighbours beyond its border follow the axis's tile style.
#include "procedural/volume/tiled_volume.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "procedural/volume/block_pyramid.h"
#include "procedural/volume/volume_grading.h"

namespace lamella {
namespace {

/// A range of voxels along an axis, both ends included.
struct VoxelSpan {
    std::size_t lo, hi;
};

/// Maps coordinates, and intervals of them, to voxels along one axis.
class TiledAxis {
  public:
    TiledAxis(std::size_t size, TileStyle style, bool linear, bool upper_of_two)
        : size_(size), style_(style), linear_(linear), upper_of_two_(upper_of_two) {}

    /// The two voxels on either side of a coordinate, and its position between them, 0 to 1.
    struct Between {
        std::size_t lower, upper;
        double t;
    };
    Between between(double s) const {
        const double place = place_of(tiled(s));
        const double lower = std::floor(place);
        return {voxel(lower), voxel(linear_ ? lower + 1 : lower), linear_ ? place - lower : 0.0};
    }

    /// Returns the voxels that coordinates from a to b can touch: at most two ranges.
    std::vector<VoxelSpan> touched(double a, double b) const {
        if (!(std::isfinite(a) && std::isfinite(b))) return {{0, size_ - 1}};
        double first = tiled(a), last = tiled(b);
        bool beyond = false;  // b is in the tile after that of a
        if (style_ == TileStyle::wrap) {
            if (b - a >= 1) return {{0, size_ - 1}};
            beyond = std::floor(a) != std::floor(b);
        } else if (style_ == TileStyle::mirror) {
            if (b - a >= 1) return {{0, size_ - 1}};
            // Turning points between a and b are ends of the cube.
            const double even = 2 * std::ceil(a / 2), odd = 2 * std::ceil((a - 1) / 2) + 1;
            if (first > last) std::swap(first, last);
            if (even <= b) first = 0;
            if (odd <= b) last = 1;
        }
        const double n = static_cast<double>(size_);
        const double lo = std::floor(place_of(first));
        const double hi = std::floor(place_of(last)) + (linear_ ? 1 : 0) + (beyond ? n : 0);
        if (style_ != TileStyle::wrap) return {{voxel(lo), voxel(hi)}};
        if (hi - lo + 1 >= n) return {{0, size_ - 1}};
        const std::size_t from = voxel(lo), to = voxel(hi);
        if (from <= to) return {{from, to}};
        return {{0, to}, {from, size_ - 1}};
    }

  private:
    double tiled(double s) const {
        switch (style_) {
            case TileStyle::wrap:
                return s - std::floor(s);
            case TileStyle::mirror:
                return 1 - std::fabs(s - 2 * std::floor(s / 2) - 1);
            default:
                return s < 0 ? 0 : s > 1 ? 1 : s;
        }
    }

    /// Returns the position in voxels: relative to the first centre, or the index of the voxel that contains
    /// it. Monotone.
    double place_of(double s) const {
        const double n = static_cast<double>(size_), g = s * n;
        if (linear_) return g - 0.5;
        const double nearest = upper_of_two_ ? std::floor(g) : std::ceil(g) - 1;
        return std::min(std::max(nearest, 0.0), n - 1);
    }

    std::size_t voxel(double place) const {
        const double n = static_cast<double>(size_);
        if (style_ == TileStyle::wrap) return static_cast<std::size_t>(place - n * std::floor(place / n));
        return static_cast<std::size_t>(std::min(std::max(place, 0.0), n - 1));
    }

    std::size_t size_;
    TileStyle style_;
    bool linear_, upper_of_two_;
};

template <class T>
class TiledVolume : public Grading {
  public:
    TiledVolume(const VoxelIndex& size, std::vector<T> samples, double full_scale, ImageFilter filter,
                const std::array<TileStyle, 3>& tiles)
        : samples_(size, std::move(samples)),
          full_scale_(full_scale),
          linear_(filter == ImageFilter::linear),
          axes_{TiledAxis(size[0], tiles[0], linear_, false), TiledAxis(size[1], tiles[1], linear_, true),
                TiledAxis(size[2], tiles[2], linear_, false)},
          pyramid_(samples_) {}

    double at(dvec3 p) const override {
        if (!std::isfinite(p.x + p.y + p.z)) return std::nan("");
        const auto x = axes_[0].between(p.x), y = axes_[1].between(p.y), z = axes_[2].between(p.z);
        if (!linear_) return sample(x.lower, y.lower, z.lower) / full_scale_;
        const auto mix = [](double a, double b, double t) { return a * (1 - t) + b * t; };
        double corners[8], rows[4];
        for (std::size_t i = 0; i < 8; ++i) {
            corners[i] = sample((i & 1U) != 0 ? x.upper : x.lower, (i & 2U) != 0 ? y.upper : y.lower,
                                (i & 4U) != 0 ? z.upper : z.lower);
        }
        for (std::size_t i = 0; i < 4; ++i) rows[i] = mix(corners[2 * i], corners[2 * i + 1], x.t);
        const double value = mix(mix(rows[0], rows[1], y.t), mix(rows[2], rows[3], y.t), z.t);
        // A mean lies between its parts, even after rounding.
        const auto [least, most] = std::minmax_element(std::begin(corners), std::end(corners));
        return (value < *least ? *least : value > *most ? *most : value) / full_scale_;
    }

    Interval range(const Box& box) const override {
        auto found = no_extremes<T>();
        for (const VoxelSpan& z : axes_[2].touched(box.lo.z, box.hi.z)) {
            for (const VoxelSpan& y : axes_[1].touched(box.lo.y, box.hi.y)) {
                for (const VoxelSpan& x : axes_[0].touched(box.lo.x, box.hi.x))
                    found.include(pyramid_.over({{x.lo, y.lo, z.lo}, {x.hi, y.hi, z.hi}}));
            }
        }
        const double lo = static_cast<double>(found.lo) / full_scale_;
        return {lo, found.undefined ? infinity : static_cast<double>(found.hi) / full_scale_};
    }

  private:
    double sample(std::size_t x, std::size_t y, std::size_t z) const {
        return static_cast<double>(samples_.at(x, y, z));
    }

    DenseSamples<T> samples_;
    double full_scale_;
    bool linear_;
    std::array<TiledAxis, 3> axes_;
    BlockPyramid<DenseSamples<T>> pyramid_;
};

}  // namespace

GradingPtr make_tiled_volume(Volume volume, ImageFilter filter, const std::array<TileStyle, 3>& tiles) {
    const bool held = std::all_of(tiles.begin(), tiles.end(), [](TileStyle tile) {
        return tile == TileStyle::clamp || tile == TileStyle::none;
    });
    // If all axes are clamped, the result is an ordinary volume, whose ranges are exact.
    if (held && filter == ImageFilter::linear)
        return make_volume_grading(std::move(volume), Box{dvec3(0), dvec3(1)});
    return std::visit(
        [&](auto& samples) -> GradingPtr {
            using Sample = typename std::decay_t<decltype(samples)>::value_type;
            const std::size_t voxels = volume.size[0] * volume.size[1] * volume.size[2];
            if (voxels == 0 || samples.size() != voxels) throw InputError("a volume needs a sample a voxel");
            return std::make_shared<TiledVolume<Sample>>(volume.size, std::move(samples), volume.full_scale,
                                                         filter, tiles);
        },
        volume.samples);
}

}  // namespace lamella
