// DensityBricks: samples that are the same over most of a volume, kept only where they are not.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/base/geometry.h"
#include "procedural/volume/voxel_samples.h"

namespace lamella {

/// Samples of single precision at the centres of the voxels that fill a box, in bricks of 8 x 8 x 8 voxels
/// (fewer at the upper border). A brick whose samples are all the same, to the last bit, keeps one of them.
class DensityBricks {
  public:
    using Sample = float;

    /// Rounds samples (x fastest, then y, then z) to single precision. `box` in mm. Throws InputError for a
    /// size that is not that of the samples or exceeds that of a volume, or a box that no volume may have.
    DensityBricks(const VoxelIndex& size, const Box& box, std::span<const double> samples);

    /// Takes what whole() and samples() give. Throws InputError as above.
    DensityBricks(const VoxelIndex& size, const Box& box, std::span<const std::uint8_t> whole,
                  std::vector<float> samples);

    /// Returns how many samples bricks keep: the first argument is the size of the volume.
    static std::size_t kept_samples(const VoxelIndex& size, std::span<const std::uint8_t> whole);
    /// Returns the number of bricks along each axis.
    static VoxelIndex brick_counts(const VoxelIndex& size);

    const VoxelIndex& size() const { return size_; }
    const Box& box() const { return box_; }  ///< mm

    float at(std::size_t x, std::size_t y, std::size_t z) const {
        return samples_[place_in(brick_of(x, y, z), x, y, z)];
    }
    /// As DenseSamples does.
    std::array<float, 8> corners(const VoxelIndex& lower, const VoxelIndex& upper) const {
        const Brick& brick = brick_of(lower[0], lower[1], lower[2]);
        if (&brick != &brick_of(upper[0], upper[1], upper[2])) return corners_of_several(lower, upper);
        const float* const first = samples_.data() + place_in(brick, lower[0], lower[1], lower[2]);
        const std::size_t x = (upper[0] - lower[0]) * brick.step[0],
                          y = (upper[1] - lower[1]) * brick.step[1],
                          z = (upper[2] - lower[2]) * brick.step[2];
        return {first[0], first[x],     first[y],     first[x + y],
                first[z], first[x + z], first[y + z], first[x + y + z]};
    }
    template <class Visit>
    void for_each_in_block(const VoxelBox& box, const Visit& visit) const {
        const Brick& brick = brick_of(box.lo[0], box.lo[1], box.lo[2]);
        if (brick.step[0] == 0) return visit(samples_[brick.first]);
        for_each_voxel(box, [&](std::size_t i, std::size_t j, std::size_t k) {
            visit(samples_[place_in(brick, i, j, k)]);
        });
    }

    /// Returns for each brick, x fastest, whether it keeps all of its samples.
    std::vector<std::uint8_t> whole() const;
    /// Returns the samples of one brick after the other, x fastest in them: one or all.
    std::span<const float> samples() const { return samples_; }
    /// Returns every sample, x fastest, then y, then z.
    std::vector<float> dense() const;
    /// Returns bricks of make(sample), which must be the same for the same sample.
    DensityBricks mapped(const std::function<float(float)>& make) const;

  private:
    /// Where the samples of a brick lie: that at (x, y, z) in it `step` times these beyond the first one. All
    /// steps of a brick with one sample are 0.
    struct Brick {
        std::uint32_t first = 0;
        std::array<std::uint8_t, 3> step{};
    };

    DensityBricks(const VoxelIndex& size, const Box& box);
    std::array<float, 8> corners_of_several(const VoxelIndex& lower, const VoxelIndex& upper) const;
    /// Sets the places of bricks.
    void lay_out(std::span<const std::uint8_t> whole);
    const Brick& brick_of(std::size_t x, std::size_t y, std::size_t z) const {
        return bricks_[(z / voxel_block * counts_[1] + y / voxel_block) * counts_[0] + x / voxel_block];
    }
    static std::size_t place_in(const Brick& brick, std::size_t x, std::size_t y, std::size_t z) {
        return brick.first + x % voxel_block * brick.step[0] + y % voxel_block * brick.step[1] +
               z % voxel_block * brick.step[2];
    }

    VoxelIndex size_, counts_;
    Box box_;
    std::vector<Brick> bricks_;
    std::vector<float> samples_;
};

}  // namespace lamella
