// What the voxels of a part say, where the part is and beside it: elsewhere nobody sees it.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "app/jobs/served_job.h"
#include "app/jobs/voxel_grid.h"

namespace lamella {

/// Cubes of voxels that are sampled together.
struct VoxelBrick {
    glm::ivec3 first{0}, end{0};
    Box box;  ///< mm, in the job as it was designed
};

/// Returns the bytes of a place of the job as it was designed, before it was scaled for the machine.
using PlaceBytes = std::function<void(dvec3 place, std::span<std::uint8_t> bytes)>;

/// What is sampled: so many bytes a voxel. `in_brick` returns what samples the places of a brick; it is
/// called for bricks that have voxels to sample, from several threads.
struct PartSampling {
    int channels = 1;
    std::function<PlaceBytes(const VoxelBrick& brick)> in_brick;
};

/// Returns a JSON head, its length in 4 bytes before it, and the bytes of each voxel, x fastest, then y, then
/// z: 0 farther than 2 voxels from those that the part covers. `more` are further members of the head. Throws
/// HttpError 400 for several parts, Interrupted when cancelled.
std::string part_samples(const ServedJob& job, int longest, const PartSampling& sampling,
                         const nlohmann::ordered_json& more, const PassControl& control);

}  // namespace lamella
