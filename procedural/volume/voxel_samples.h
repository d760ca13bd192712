// Samples on a grid, as gradings and pyramids of extremes read them: one after the other in memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace lamella {

/// A position in a volume, or its size: along x, y and z.
using VoxelIndex = std::array<std::size_t, 3>;

/// A range of indices along each axis, both ends included.
struct VoxelBox {
    VoxelIndex lo, hi;

    std::size_t longest() const { return std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]}) + 1; }
    bool encloses(const VoxelBox& other) const {
        for (std::size_t i = 0; i < 3; ++i) {
            if (other.lo[i] < lo[i] || hi[i] < other.hi[i]) return false;
        }
        return true;
    }
};

/// Calls visit(i, j, k) for every voxel of a box, x fastest.
template <class Visit>
void for_each_voxel(const VoxelBox& box, const Visit& visit) {
    for (std::size_t k = box.lo[2]; k <= box.hi[2]; ++k) {
        for (std::size_t j = box.lo[1]; j <= box.hi[1]; ++j) {
            for (std::size_t i = box.lo[0]; i <= box.hi[0]; ++i) visit(i, j, k);
        }
    }
}

/// Blocks of so many samples per side are read together: extremes are kept by block, bricks are blocks.
constexpr std::size_t voxel_block = 8;

/// Returns the box of a block in a volume; those at its upper border may be smaller.
inline VoxelBox voxels_of_block(const VoxelIndex& block, const VoxelIndex& size) {
    VoxelBox box{};
    for (std::size_t i = 0; i < 3; ++i) {
        box.lo[i] = block[i] * voxel_block;
        box.hi[i] = std::min(box.lo[i] + voxel_block, size[i]) - 1;
    }
    return box;
}

/// All samples, x fastest, then y, then z. Whatever else gives samples has the same functions (see
/// density_bricks.h).
template <class T>
class DenseSamples {
  public:
    using Sample = T;

    DenseSamples(const VoxelIndex& size, std::vector<T> samples)
        : size_(size), samples_(std::move(samples)) {}

    const VoxelIndex& size() const { return size_; }
    T at(std::size_t x, std::size_t y, std::size_t z) const {
        return samples_[(z * size_[1] + y) * size_[0] + x];
    }
    /// Returns the samples at the corners of a box of neighbours, x fastest.
    std::array<T, 8> corners(const VoxelIndex& lower, const VoxelIndex& upper) const {
        std::array<T, 8> found;
        for (std::size_t i = 0; i < 8; ++i) {
            found[i] = at((i & 1U) != 0 ? upper[0] : lower[0], (i & 2U) != 0 ? upper[1] : lower[1],
                          (i & 4U) != 0 ? upper[2] : lower[2]);
        }
        return found;
    }
    /// Calls visit(sample) for the samples in a box that lies in one block.
    template <class Visit>
    void for_each_in_block(const VoxelBox& box, const Visit& visit) const {
        for_each_voxel(box, [&](std::size_t i, std::size_t j, std::size_t k) { visit(at(i, j, k)); });
    }

  private:
    VoxelIndex size_;
    std::vector<T> samples_;
};

}  // namespace lamella
