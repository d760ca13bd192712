// Divides a box into cubes.
#include "app/jobs/voxel_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "recipe/build/json_triple.h"

namespace lamella {

VoxelGrid voxel_grid(const Box& box, int longest) {
    const dvec3 extent = box.size();
    VoxelGrid grid;
    grid.voxel = std::max({extent.x, extent.y, extent.z}) / longest;
    const auto voxels = [&](double length) {
        return std::max(1, static_cast<int>(std::ceil(length / grid.voxel - 1e-9)));
    };
    grid.size = {voxels(extent.x), voxels(extent.y), voxels(extent.z)};
    grid.lo = box.center() - 0.5 * grid.voxel * dvec3(grid.size);
    return grid;
}

nlohmann::ordered_json grid_head(const VoxelGrid& grid, int channels) {
    return {{"size", {grid.size.x, grid.size.y, grid.size.z}},
            {"lo", json_triple(grid.lo)},
            {"hi", json_triple(grid.hi())},
            {"channels", channels}};
}

std::string headed(const nlohmann::ordered_json& head) {
    const std::string text = head.dump();
    std::string bytes;
    for (unsigned shift = 0; shift < 32; shift += 8)
        bytes.push_back(static_cast<char>(static_cast<std::uint8_t>(text.size() >> shift)));
    return bytes + text;
}

}  // namespace lamella
