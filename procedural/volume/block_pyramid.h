// BlockPyramid: a hierarchy of block extremes, for the range of a volume's samples over boxes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "engine/base/geometry.h"
#include "procedural/volume/voxel_samples.h"

namespace lamella {

/// Minimum and maximum of samples. NaN is tracked separately, because it has no order.
template <class T>
struct SampleExtremes {
    T lo, hi;
    /// a NaN or an infinity is among them; interpolated numbers next to it may be NaN
    bool undefined = false;

    void include(const SampleExtremes& other) {
        lo = std::min(lo, other.lo);
        hi = std::max(hi, other.hi);
        undefined = undefined || other.undefined;
    }
};

template <class T>
bool is_finite_sample(T value) {
    if constexpr (std::is_floating_point_v<T>) return std::isfinite(value);
    return true;
}

/// Returns the extremes of no samples.
template <class T>
SampleExtremes<T> no_extremes() {
    if constexpr (std::is_floating_point_v<T>) return {static_cast<T>(infinity), static_cast<T>(-infinity)};
    return {std::numeric_limits<T>::max(), std::numeric_limits<T>::lowest()};
}

template <class T>
void include_sample(SampleExtremes<T>& extremes, T sample) {
    extremes.undefined = extremes.undefined || !is_finite_sample(sample);
    if (sample < extremes.lo) extremes.lo = sample;
    if (sample > extremes.hi) extremes.hi = sample;
}

/// The extremes of the samples over blocks of 8 x 8 x 8, over 2 x 2 x 2 of these blocks, and so on up to a
/// single block. Keeps a reference to the samples (see voxel_samples.h).
template <class Samples>
class BlockPyramid {
  public:
    using T = typename Samples::Sample;

    explicit BlockPyramid(const Samples& samples) : size_(samples.size()), samples_(samples) {
        add_level(size_, voxel_block, [this](const VoxelBox& inside) { return of_samples(inside); });
        while (levels_.back().values.size() > 1) {
            const Level& below = levels_.back();
            add_level(below.size, 2, [&below](const VoxelBox& inside) {
                auto extremes = no_extremes<T>();
                for_each_voxel(inside, [&](std::size_t i, std::size_t j, std::size_t k) {
                    extremes.include(below.at({i, j, k}));
                });
                return extremes;
            });
        }
    }

    /// Returns bounds of the samples in a box. Exact if the box is up to four blocks long; otherwise they
    /// include samples up to a quarter of its length beyond it.
    SampleExtremes<T> over(const VoxelBox& box) const {
        auto found = no_extremes<T>();
        const std::size_t top = levels_.size() - 1;
        std::size_t finest = 0;  // blocks of levels below this one are not opened
        for (std::size_t side = voxel_block * coarse; side < box.longest(); side *= 2) ++finest;
        visit(found, box, top, {0, 0, 0}, finest);
        return found;
    }

  private:
    /// Boxes of up to so many blocks per side are evaluated sample by sample at their border.
    static constexpr std::size_t coarse = 4;

    struct Level {
        VoxelIndex size;
        std::size_t side;  ///< of a block, in samples
        std::vector<SampleExtremes<T>> values;
        const SampleExtremes<T>& at(const VoxelIndex& i) const {
            return values[(i[2] * size[1] + i[1]) * size[0] + i[0]];
        }
    };

    /// Returns the extremes in a box that lies in one block.
    SampleExtremes<T> of_samples(const VoxelBox& inside) const {
        auto extremes = no_extremes<T>();
        samples_.for_each_in_block(inside, [&](T sample) { include_sample(extremes, sample); });
        return extremes;
    }

    /// Returns the indices, in the level below, of a block of `by` entries per side.
    static VoxelBox children(const VoxelIndex& block, std::size_t by, const VoxelIndex& below) {
        VoxelBox inside;
        for (std::size_t i = 0; i < 3; ++i) {
            inside.lo[i] = block[i] * by;
            inside.hi[i] = std::min(inside.lo[i] + by, below[i]) - 1;
        }
        return inside;
    }

    template <class Summary>
    void add_level(const VoxelIndex& below, std::size_t by, const Summary& summary) {
        Level level;
        level.side = levels_.empty() ? voxel_block : levels_.back().side * 2;
        for (std::size_t i = 0; i < 3; ++i) level.size[i] = (below[i] + by - 1) / by;
        level.values.reserve(level.size[0] * level.size[1] * level.size[2]);
        for_each_voxel({{0, 0, 0}, {level.size[0] - 1, level.size[1] - 1, level.size[2] - 1}},
                       [&](std::size_t i, std::size_t j, std::size_t k) {
                           level.values.push_back(summary(children({i, j, k}, by, below)));
                       });
        levels_.push_back(std::move(level));
    }

    void visit(SampleExtremes<T>& found, const VoxelBox& box, std::size_t number, const VoxelIndex& block,
               std::size_t finest) const {
        const Level& level = levels_[number];
        const SampleExtremes<T>& below = level.at(block);
        if (found.lo <= below.lo && below.hi <= found.hi && found.undefined >= below.undefined) return;
        const VoxelBox samples = children(block, level.side, size_);
        if (number < finest || box.encloses(samples)) return found.include(below);
        VoxelBox common;
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
        for_each_voxel(common, [&](std::size_t i, std::size_t j, std::size_t k) {
            visit(found, box, number - 1, {i, j, k}, finest);
        });
    }

    VoxelIndex size_;
    const Samples& samples_;
    std::vector<Level> levels_;
};

}  // namespace lamella
