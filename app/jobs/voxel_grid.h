// VoxelGrid: the cubes of a volume that a server sends.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include <glm/vec3.hpp>
#include "engine/base/geometry.h"

namespace lamella {

/// Cubes around a box; x goes fastest, then y, then z.
struct VoxelGrid {
    glm::ivec3 size{0};
    dvec3 lo{0};
    double voxel = 1;  ///< edge, mm

    dvec3 hi() const { return lo + voxel * dvec3(size); }
    dvec3 middle(glm::ivec3 at) const { return lo + voxel * (dvec3(at) + 0.5); }
    std::size_t plane() const { return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y); }
    std::size_t voxels() const { return plane() * static_cast<std::size_t>(size.z); }
    std::size_t place(glm::ivec3 at) const {
        return static_cast<std::size_t>(at.x) +
               static_cast<std::size_t>(size.x) * static_cast<std::size_t>(at.y) +
               plane() * static_cast<std::size_t>(at.z);
    }
};

/// Returns the grid around a box whose longest side has so many voxels.
VoxelGrid voxel_grid(const Box& box, int longest);

/// Returns the grid as the head of a volume: "size", "lo", "hi" and "channels", the bytes of a voxel.
nlohmann::ordered_json grid_head(const VoxelGrid& grid, int channels);

/// Returns a head of JSON with its length in 4 bytes before it, little-endian.
std::string headed(const nlohmann::ordered_json& head);

}  // namespace lamella
