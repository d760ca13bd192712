// A first pass over the samples finds the bricks with one value, a second one collects the rest.
#include "procedural/volume/density_bricks.h"

#include <algorithm>
#include <bit>

#include "engine/base/error.h"
#include "procedural/volume/volume.h"

namespace lamella {

namespace {

/// Calls visit(number, box) for every brick of a volume, x fastest.
template <class Visit>
void for_each_brick(const VoxelIndex& size, const Visit& visit) {
    const VoxelIndex counts = DensityBricks::brick_counts(size);
    std::size_t number = 0;
    for_each_voxel({{0, 0, 0}, {counts[0] - 1, counts[1] - 1, counts[2] - 1}},
                   [&](std::size_t i, std::size_t j, std::size_t k) {
                       visit(number++, voxels_of_block({i, j, k}, size));
                   });
}

VoxelIndex sides_of(const VoxelBox& box) {
    return {box.hi[0] - box.lo[0] + 1, box.hi[1] - box.lo[1] + 1, box.hi[2] - box.lo[2] + 1};
}

std::size_t voxels_in(const VoxelIndex& sides) { return sides[0] * sides[1] * sides[2]; }

}  // namespace

DensityBricks::DensityBricks(const VoxelIndex& size, const Box& box)
    : size_(size), counts_(brick_counts(size)), box_(box) {
    check_volume_size(size, sizeof(float), "densities");
    check_volume_box(box);
    if (voxels_in(size) == 0) throw InputError("a volume needs a voxel or more along each axis");
}

DensityBricks::DensityBricks(const VoxelIndex& size, const Box& box, std::span<const double> samples)
    : DensityBricks(size, box) {
    if (samples.size() != voxels_in(size)) throw InputError("a volume needs a sample a voxel");
    const auto sample = [&](std::size_t i, std::size_t j, std::size_t k) {
        return static_cast<float>(samples[(k * size[1] + j) * size[0] + i]);
    };
    std::vector<std::uint8_t> whole(voxels_in(counts_));
    for_each_brick(size, [&](std::size_t number, const VoxelBox& brick) {
        const auto first = std::bit_cast<std::uint32_t>(sample(brick.lo[0], brick.lo[1], brick.lo[2]));
        bool differs = false;
        for_each_voxel(brick, [&](std::size_t i, std::size_t j, std::size_t k) {
            differs = differs || std::bit_cast<std::uint32_t>(sample(i, j, k)) != first;
        });
        whole[number] = differs;
    });
    lay_out(whole);
    samples_.reserve(kept_samples(size, whole));
    for_each_brick(size, [&](std::size_t number, const VoxelBox& brick) {
        if (whole[number] == 0) return samples_.push_back(sample(brick.lo[0], brick.lo[1], brick.lo[2]));
        for_each_voxel(
            brick, [&](std::size_t i, std::size_t j, std::size_t k) { samples_.push_back(sample(i, j, k)); });
    });
}

DensityBricks::DensityBricks(const VoxelIndex& size, const Box& box, std::span<const std::uint8_t> whole,
                             std::vector<float> samples)
    : DensityBricks(size, box) {
    if (whole.size() != voxels_in(counts_) || samples.size() != kept_samples(size, whole))
        throw InputError("bricks need as many samples as their list says");
    lay_out(whole);
    samples_ = std::move(samples);
}

void DensityBricks::lay_out(std::span<const std::uint8_t> whole) {
    bricks_.resize(whole.size());
    std::size_t next = 0;
    for_each_brick(size_, [&](std::size_t number, const VoxelBox& box) {
        Brick& brick = bricks_[number];
        brick.first = static_cast<std::uint32_t>(next);
        if (whole[number] == 0) {
            ++next;
            return;
        }
        const VoxelIndex sides = sides_of(box);
        brick.step = {1, static_cast<std::uint8_t>(sides[0]), static_cast<std::uint8_t>(sides[0] * sides[1])};
        next += voxels_in(sides);
    });
}

std::size_t DensityBricks::kept_samples(const VoxelIndex& size, std::span<const std::uint8_t> whole) {
    std::size_t count = 0;
    for_each_brick(size, [&](std::size_t number, const VoxelBox& brick) {
        count += whole[number] == 0 ? 1 : voxels_in(sides_of(brick));
    });
    return count;
}

VoxelIndex DensityBricks::brick_counts(const VoxelIndex& size) {
    const auto along = [](std::size_t side) {
        return side / voxel_block + (side % voxel_block != 0 ? 1 : 0);
    };
    return {along(size[0]), along(size[1]), along(size[2])};
}

std::array<float, 8> DensityBricks::corners_of_several(const VoxelIndex& lower,
                                                       const VoxelIndex& upper) const {
    // By axis, of the lower and the upper neighbour.
    std::array<std::array<std::size_t, 2>, 3> brick, inside;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        brick[axis] = {lower[axis] / voxel_block, upper[axis] / voxel_block};
        inside[axis] = {lower[axis] % voxel_block, upper[axis] % voxel_block};
    }
    std::array<float, 8> found;
    for (std::size_t i = 0; i < 8; ++i) {
        const std::size_t x = i & 1U, y = i >> 1U & 1U, z = i >> 2U;
        const Brick& of = bricks_[(brick[2][z] * counts_[1] + brick[1][y]) * counts_[0] + brick[0][x]];
        found[i] = samples_[of.first + inside[0][x] * of.step[0] + inside[1][y] * of.step[1] +
                            inside[2][z] * of.step[2]];
    }
    return found;
}

std::vector<std::uint8_t> DensityBricks::whole() const {
    std::vector<std::uint8_t> found;
    found.reserve(bricks_.size());
    for (const Brick& brick : bricks_) found.push_back(brick.step[0] != 0);
    return found;
}

std::vector<float> DensityBricks::dense() const {
    std::vector<float> found;
    found.reserve(voxels_in(size_));
    for_each_voxel({{0, 0, 0}, {size_[0] - 1, size_[1] - 1, size_[2] - 1}},
                   [&](std::size_t i, std::size_t j, std::size_t k) { found.push_back(at(i, j, k)); });
    return found;
}

DensityBricks DensityBricks::mapped(const std::function<float(float)>& make) const {
    DensityBricks result = *this;
    std::ranges::transform(result.samples_, result.samples_.begin(), make);
    return result;
}

}  // namespace lamella
