// Trilinear interpolation between voxels, and ranges from their extremes over blocks of blocks.
#include "procedural/volume_grading.h"

#include <algorithm>
#include <memory>
#include <type_traits>

#include "engine/error.h"

namespace lamella {
namespace {

using Index = std::array<std::size_t, 3>;

/// A span of indices along each axis, both ends included.
struct IndexBox {
    Index lo, hi;

    std::size_t longest() const { return std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]}) + 1; }
    bool encloses(const IndexBox& other) const {
        for (std::size_t i = 0; i < 3; ++i) {
            if (other.lo[i] < lo[i] || hi[i] < other.hi[i]) return false;
        }
        return true;
    }
};

/// Calls visit(i, j, k) for every place of a box, x fastest.
template <class Visit>
void for_each(const IndexBox& box, const Visit& visit) {
    for (std::size_t k = box.lo[2]; k <= box.hi[2]; ++k) {
        for (std::size_t j = box.lo[1]; j <= box.hi[1]; ++j) {
            for (std::size_t i = box.lo[0]; i <= box.hi[0]; ++i) visit(i, j, k);
        }
    }
}

/// Least and greatest sample; a NaN is kept apart because it has no place in an order.
template <class T>
struct Extremes {
    T lo, hi;
    bool undefined = false;  ///< a NaN or an infinity is among them, between which numbers are NaN

    void include(const Extremes& other) {
        lo = std::min(lo, other.lo);
        hi = std::max(hi, other.hi);
        undefined = undefined || other.undefined;
    }
};

template <class T>
bool is_finite(T value) {
    if constexpr (std::is_floating_point_v<T>) return std::isfinite(value);
    return true;
}

/// Nothing yet: what every sample widens.
template <class T>
Extremes<T> no_extremes() {
    if constexpr (std::is_floating_point_v<T>) return {static_cast<T>(infinity), static_cast<T>(-infinity)};
    return {std::numeric_limits<T>::max(), std::numeric_limits<T>::lowest()};
}

template <class T>
void include(Extremes<T>& extremes, T sample) {
    extremes.undefined = extremes.undefined || !is_finite(sample);
    if (sample < extremes.lo) extremes.lo = sample;
    if (sample > extremes.hi) extremes.hi = sample;
}

/// The samples' extremes over blocks of 8 x 8 x 8, over 8 of these, and so on up to one block.
template <class T>
class BlockPyramid {
  public:
    BlockPyramid(const Index& size, const std::vector<T>& samples) : size_(size), samples_(samples) {
        add_level(size, block_side, [this](const IndexBox& inside) { return of_samples(inside); });
        while (levels_.back().values.size() > 1) {
            const Level& below = levels_.back();
            add_level(below.size, 2, [&below](const IndexBox& inside) {
                auto extremes = no_extremes<T>();
                for_each(inside, [&](std::size_t i, std::size_t j, std::size_t k) {
                    extremes.include(below.at({i, j, k}));
                });
                return extremes;
            });
        }
    }

    /// Encloses the samples of a box: exact where it is a few blocks long, within an eighth of its length
    /// beyond where it is longer.
    Extremes<T> over(const IndexBox& box) const {
        auto found = no_extremes<T>();
        const std::size_t top = levels_.size() - 1;
        std::size_t finest = 0;  // the level whose blocks are not opened any more, counted as levels below
        for (std::size_t side = block_side * coarse; side < box.longest(); side *= 2) ++finest;
        visit(found, box, top, {0, 0, 0}, finest);
        return found;
    }

  private:
    static constexpr std::size_t block_side = 8;
    /// Boxes of this many blocks a side are looked at sample by sample at their rim.
    static constexpr std::size_t coarse = 4;

    struct Level {
        Index size;
        std::size_t side;  ///< of a block, in samples
        std::vector<Extremes<T>> values;
        const Extremes<T>& at(const Index& i) const {
            return values[(i[2] * size[1] + i[1]) * size[0] + i[0]];
        }
    };

    Extremes<T> of_samples(const IndexBox& inside) const {
        auto extremes = no_extremes<T>();
        for_each(inside, [&](std::size_t i, std::size_t j, std::size_t k) {
            lamella::include(extremes, samples_[(k * size_[1] + j) * size_[0] + i]);
        });
        return extremes;
    }

    /// The places of the level below that a block of `by` places a side covers.
    static IndexBox children(const Index& block, std::size_t by, const Index& below) {
        IndexBox inside;
        for (std::size_t i = 0; i < 3; ++i) {
            inside.lo[i] = block[i] * by;
            inside.hi[i] = std::min(inside.lo[i] + by, below[i]) - 1;
        }
        return inside;
    }

    template <class Summary>
    void add_level(const Index& below, std::size_t by, const Summary& summary) {
        Level level;
        level.side = levels_.empty() ? block_side : levels_.back().side * 2;
        for (std::size_t i = 0; i < 3; ++i) level.size[i] = (below[i] + by - 1) / by;
        level.values.reserve(level.size[0] * level.size[1] * level.size[2]);
        for_each({{0, 0, 0}, {level.size[0] - 1, level.size[1] - 1, level.size[2] - 1}},
                 [&](std::size_t i, std::size_t j, std::size_t k) {
                     level.values.push_back(summary(children({i, j, k}, by, below)));
                 });
        levels_.push_back(std::move(level));
    }

    void visit(Extremes<T>& found, const IndexBox& box, std::size_t number, const Index& block,
               std::size_t finest) const {
        const Level& level = levels_[number];
        const Extremes<T>& below = level.at(block);
        if (found.lo <= below.lo && below.hi <= found.hi && found.undefined >= below.undefined) return;
        const IndexBox samples = children(block, level.side, size_);
        if (number < finest || box.encloses(samples)) return found.include(below);
        IndexBox common;
        for (std::size_t i = 0; i < 3; ++i) {
            common.lo[i] = std::max(box.lo[i], samples.lo[i]);
            common.hi[i] = std::min(box.hi[i], samples.hi[i]);
            if (common.lo[i] > common.hi[i]) return;
        }
        if (number == 0) return found.include(of_samples(common));
        const std::size_t side = levels_[number - 1].side;
        for (std::size_t i = 0; i < 3; ++i) {
            common.lo[i] /= side;
            common.hi[i] /= side;
        }
        for_each(common, [&](std::size_t i, std::size_t j, std::size_t k) {
            visit(found, box, number - 1, {i, j, k}, finest);
        });
    }

    Index size_;
    const std::vector<T>& samples_;
    std::vector<Level> levels_;
};

/// Where a coordinate lies between the centres of two neighbouring voxels.
struct Between {
    std::size_t lower, upper;
    double t;  ///< 0 at the lower one, 1 at the upper one
};

template <class T>
class VolumeGrading : public Grading {
  public:
    VolumeGrading(const Index& size, std::vector<T> samples, double full_scale, const Box& box)
        : size_(size),
          samples_(std::move(samples)),
          full_scale_(full_scale),
          box_(box),
          pyramid_(size_, samples_) {}

    double at(dvec3 p) const override {
        const dvec3 g = in_voxels(p);
        return interpolated({split(g.x, 0), split(g.y, 1), split(g.z, 2)}) / full_scale_;
    }

    Interval range(const Box& box) const override {
        const dvec3 lo = in_voxels(box.lo), hi = in_voxels(box.hi);
        IndexBox touched;
        bool is_small = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto axis = static_cast<int>(i);
            touched.lo[i] = split(lo[axis], i).lower;
            touched.hi[i] = split(hi[axis], i).upper;
            is_small = is_small && touched.hi[i] - touched.lo[i] <= most_stops;
        }
        const Extremes<T> samples = pyramid_.over(touched);
        Interval range{static_cast<double>(samples.lo), static_cast<double>(samples.hi)};
        if (samples.undefined) return {range.lo / full_scale_, infinity};
        if (is_small) range = at_stops(lo, hi, range);
        return {range.lo / full_scale_, range.hi / full_scale_};
    }

  private:
    /// Boxes over this many voxels a side are cut along the planes of the centres.
    static constexpr std::size_t most_stops = 5;

    /// In voxels from the first centre, kept between the outermost ones. Monotone, also when rounded.
    dvec3 in_voxels(dvec3 p) const {
        dvec3 g;
        for (int i = 0; i < 3; ++i) {
            const double last = static_cast<double>(size_[static_cast<std::size_t>(i)] - 1);
            const double place = (p[i] - box_.lo[i]) / (box_.hi[i] - box_.lo[i]) * (last + 1) - 0.5;
            g[i] = place >= last ? last : place > 0 ? place : 0.0;  // NaN lies at the first
        }
        return g;
    }

    Between split(double g, std::size_t axis) const {
        const auto lower = static_cast<std::size_t>(g);
        return {lower, std::min(lower + 1, size_[axis] - 1), g - static_cast<double>(lower)};
    }

    double sample(std::size_t x, std::size_t y, std::size_t z) const {
        return static_cast<double>(samples_[(z * size_[1] + y) * size_[0] + x]);
    }

    double interpolated(const std::array<Between, 3>& at) const {
        const auto& [x, y, z] = at;
        double corners[8];
        for (std::size_t i = 0; i < 8; ++i) {
            corners[i] = sample((i & 1U) != 0 ? x.upper : x.lower, (i & 2U) != 0 ? y.upper : y.lower,
                                (i & 4U) != 0 ? z.upper : z.lower);
        }
        const auto [least, most] = std::minmax_element(std::begin(corners), std::end(corners));
        const Interval limits{*least, *most};
        const auto mix = [](double a, double b, double t) { return a * (1 - t) + b * t; };
        double rows[4];
        for (std::size_t i = 0; i < 4; ++i) rows[i] = mix(corners[2 * i], corners[2 * i + 1], x.t);
        const double value = mix(mix(rows[0], rows[1], y.t), mix(rows[2], rows[3], y.t), z.t);
        // A mean lies between its parts, also when rounded: equal voxels give their number exactly.
        return value < limits.lo ? limits.lo : value > limits.hi ? limits.hi : value;
    }

    /// The extremes over a box of few voxels: between the planes of the centres the number is linear along
    /// each axis, so it is extreme at corners.
    Interval at_stops(dvec3 lo, dvec3 hi, Interval samples) const {
        std::array<std::array<Between, most_stops + 2>, 3> stops;
        IndexBox all{{0, 0, 0}, {0, 0, 0}};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto axis = static_cast<int>(i);
            stops[i][0] = split(lo[axis], i);
            for (std::size_t centre = stops[i][0].lower + 1; static_cast<double>(centre) < hi[axis];
                 ++centre) {
                stops[i][++all.hi[i]] = split(static_cast<double>(centre), i);
            }
            stops[i][++all.hi[i]] = split(hi[axis], i);
        }
        Interval range;
        for_each(all, [&](std::size_t i, std::size_t j, std::size_t k) {
            const double number = interpolated({stops[0][i], stops[1][j], stops[2][k]});
            range = {std::min(range.lo, number), std::max(range.hi, number)};
        });
        const double rounding = 1e-15 * 8 * std::max(std::abs(samples.lo), std::abs(samples.hi));
        return {std::max(range.lo - rounding, samples.lo), std::min(range.hi + rounding, samples.hi)};
    }

    Index size_;
    std::vector<T> samples_;
    double full_scale_;
    Box box_;
    BlockPyramid<T> pyramid_;
};

}  // namespace

GradingPtr make_volume_grading(Volume volume, const Box& box) {
    for (int i = 0; i < 3; ++i) {
        const bool finite = std::abs(box.lo[i]) <= 1e9 && std::abs(box.hi[i]) <= 1e9;
        if (!finite || !(box.lo[i] < box.hi[i])) {
            throw InputError(
                "the box of a volume must have three positive sides, within 1e9 mm of the origin");
        }
    }
    return std::visit(
        [&](auto& samples) -> GradingPtr {
            using Sample = typename std::decay_t<decltype(samples)>::value_type;
            const std::size_t voxels = volume.size[0] * volume.size[1] * volume.size[2];
            if (voxels == 0 || samples.size() != voxels) throw InputError("a volume needs a sample a voxel");
            return std::make_shared<VolumeGrading<Sample>>(volume.size, std::move(samples), volume.full_scale,
                                                           box);
        },
        volume.samples);
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
