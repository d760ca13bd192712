// Trilinear interpolation between voxels, and ranges from a pyramid of block extremes.
#include "procedural/volume/volume_grading.h"

#include <algorithm>
#include <memory>

#include "engine/base/error.h"
#include "procedural/volume/block_pyramid.h"

namespace lamella {
namespace {

/// The position of a coordinate between the centres of two adjacent voxels.
struct Between {
    std::size_t lower, upper;
    double t;  ///< 0 at the lower one, 1 at the upper one
};

/// The voxels round a place, x fastest.
struct Cell {
    VoxelIndex lower;
    double corners[8];
    Interval limits;  ///< of the corners, except NaN

    bool holds(const std::array<Between, 3>& place) const {
        return place[0].lower == lower[0] && place[1].lower == lower[1] && place[2].lower == lower[2];
    }
};

/// Returns the trilinear mean at a place in a cell.
double mixed(const Cell& cell, const std::array<Between, 3>& place) {
    const auto& [x, y, z] = place;
    const auto mix = [](double a, double b, double t) { return a * (1 - t) + b * t; };
    double rows[4];
    for (std::size_t i = 0; i < 4; ++i) rows[i] = mix(cell.corners[2 * i], cell.corners[2 * i + 1], x.t);
    const double value = mix(mix(rows[0], rows[1], y.t), mix(rows[2], rows[3], y.t), z.t);
    // A mean lies between its parts, even after rounding: equal voxels give their number exactly.
    return value < cell.limits.lo ? cell.limits.lo : value > cell.limits.hi ? cell.limits.hi : value;
}

template <class Samples>
class VolumeGrading : public Grading {
  public:
    VolumeGrading(std::shared_ptr<const Samples> samples, double full_scale, const Box& box)
        : samples_(std::move(samples)),
          size_(samples_->size()),
          full_scale_(full_scale),
          lower_(box.lo),
          extent_(box.hi - box.lo),
          voxels_(size_[0], size_[1], size_[2]),
          pyramid_(*samples_) {}

    double at(dvec3 p) const override {
        const auto place = split(in_voxels(p));
        return mixed(cell_at(place), place) / full_scale_;
    }

    /// Points that follow each other lie between the same voxels more often than not.
    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        if (points.empty()) return;
        Cell cell = cell_at(split(in_voxels(points[0])));
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto place = split(in_voxels(points[i]));
            if (!cell.holds(place)) cell = cell_at(place);
            out[i] = mixed(cell, place) / full_scale_;
        }
    }

    Interval range(const Box& box) const override {
        const dvec3 lo = in_voxels(box.lo), hi = in_voxels(box.hi);
        VoxelBox touched;
        bool is_small = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto axis = static_cast<int>(i);
            touched.lo[i] = split(lo[axis], i).lower;
            touched.hi[i] = split(hi[axis], i).upper;
            is_small = is_small && touched.hi[i] - touched.lo[i] <= max_stops;
        }
        const SampleExtremes<typename Samples::Sample> samples = pyramid_.over(touched);
        Interval range{static_cast<double>(samples.lo), static_cast<double>(samples.hi)};
        if (samples.undefined) return {range.lo / full_scale_, infinity};
        if (is_small && range.lo < range.hi) range = at_stops(lo, hi, range);
        return {range.lo / full_scale_, range.hi / full_scale_};
    }

  private:
    /// Boxes with up to so many voxel centres per side are evaluated at the planes of the centres.
    static constexpr std::size_t max_stops = 5;

    /// Returns the position in voxels from the first centre, clamped to the outermost ones. Monotone, even
    /// after rounding.
    dvec3 in_voxels(dvec3 p) const {
        dvec3 g;
        for (int i = 0; i < 3; ++i) {
            const double last = voxels_[i] - 1;
            const double place = (p[i] - lower_[i]) / extent_[i] * voxels_[i] - 0.5;
            g[i] = place >= last ? last : place > 0 ? place : 0.0;  // NaN becomes 0
        }
        return g;
    }

    std::array<Between, 3> split(dvec3 g) const { return {split(g.x, 0), split(g.y, 1), split(g.z, 2)}; }

    Between split(double g, std::size_t axis) const {
        const auto whole = static_cast<std::int64_t>(g);  // faster than unsigned
        const auto lower = static_cast<std::size_t>(whole);
        return {lower, std::min(lower + 1, size_[axis] - 1), g - static_cast<double>(whole)};
    }

    Cell cell_at(const std::array<Between, 3>& place) const {
        const auto& [x, y, z] = place;
        Cell cell;
        cell.lower = {x.lower, y.lower, z.lower};
        const auto samples = samples_->corners(cell.lower, {x.upper, y.upper, z.upper});
        for (std::size_t i = 0; i < 8; ++i) {
            const auto corner = static_cast<double>(samples[i]);
            cell.corners[i] = corner;
            cell.limits.lo = corner < cell.limits.lo ? corner : cell.limits.lo;
            cell.limits.hi = corner > cell.limits.hi ? corner : cell.limits.hi;
        }
        return cell;
    }

    /// Returns the range over a box of few voxels. Between the planes of the centres the number is linear
    /// along each axis, so its extremes are at corners.
    Interval at_stops(dvec3 lo, dvec3 hi, Interval samples) const {
        std::array<std::array<Between, max_stops + 2>, 3> stops;
        VoxelBox all{{0, 0, 0}, {0, 0, 0}};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto axis = static_cast<int>(i);
            stops[i][0] = split(lo[axis], i);
            for (std::size_t centre = stops[i][0].lower + 1; static_cast<double>(centre) < hi[axis];
                 ++centre) {
                stops[i][++all.hi[i]] = split(static_cast<double>(centre), i);
            }
            if (lo[axis] != hi[axis]) stops[i][++all.hi[i]] = split(hi[axis], i);
        }
        Interval range;
        Cell cell = cell_at({stops[0][0], stops[1][0], stops[2][0]});
        for_each_voxel(all, [&](std::size_t i, std::size_t j, std::size_t k) {
            const std::array<Between, 3> place{stops[0][i], stops[1][j], stops[2][k]};
            if (!cell.holds(place)) cell = cell_at(place);
            const double number = mixed(cell, place);
            range = {std::min(range.lo, number), std::max(range.hi, number)};
        });
        const double rounding = 1e-15 * 8 * std::max(std::abs(samples.lo), std::abs(samples.hi));
        return {std::max(range.lo - rounding, samples.lo), std::min(range.hi + rounding, samples.hi)};
    }

    std::shared_ptr<const Samples> samples_;
    VoxelIndex size_;
    double full_scale_;
    dvec3 lower_, extent_;  ///< of the box, mm
    dvec3 voxels_;          ///< along each axis
    BlockPyramid<Samples> pyramid_;
};

}  // namespace

GradingPtr make_volume_grading(Volume volume, const Box& box) {
    check_volume_box(box);
    return std::visit(
        [&](auto& samples) -> GradingPtr {
            using Sample = typename std::decay_t<decltype(samples)>::value_type;
            const std::size_t voxels = volume.size[0] * volume.size[1] * volume.size[2];
            if (voxels == 0 || samples.size() != voxels) throw InputError("a volume needs a sample a voxel");
            auto dense = std::make_shared<const DenseSamples<Sample>>(volume.size, std::move(samples));
            return std::make_shared<VolumeGrading<DenseSamples<Sample>>>(std::move(dense), volume.full_scale,
                                                                         box);
        },
        volume.samples);
}

GradingPtr make_volume_grading(std::shared_ptr<const DensityBricks> bricks) {
    const Box box = bricks->box();
    return std::make_shared<VolumeGrading<DensityBricks>>(std::move(bricks), 1.0, box);
}

GradingPtr make_volume_grading(const VolumeSource& source) {
    Volume volume = read_volume(source.path, source.channel);
    const std::optional<Box> box = source.box ? source.box : volume.box;
    if (!box) {
        throw InputError(
            source.path +
            ": the file does not say where the volume lies (an NRRD file does by spacings, or by "
            "space directions along +x, +y and +z, in mm); state its box");
    }
    try {
        return make_volume_grading(std::move(volume), *box);
    } catch (const InputError& error) {
        throw InputError(source.path + ": " + error.what());
    }
}

}  // namespace lamella
