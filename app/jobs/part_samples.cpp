// Marks the voxels near the part, then samples them brick by brick.
#include "app/jobs/part_samples.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/http/http_server.h"
#include "app/jobs/layer_content.h"
#include "app/reports/grey_page.h"
#include "engine/base/cancel_token.h"
#include "engine/base/parallel.h"
#include "engine/field/slice_context.h"

namespace lamella {

namespace {

constexpr int reach = 2;        // voxels: as far as what is drawn may lie from a voxel that is covered
constexpr int brick_edge = 12;  // voxels

/// Returns a place of the job as it was designed, before it was scaled for the machine.
dvec3 designed_place(const ServedJob& job, dvec3 place) {
    if (!job.recipe.process) return place;
    const Box& bounds = job.built.designed.bounds;
    const dvec3 fixed(bounds.center().x, bounds.center().y, bounds.lo.z);
    return fixed + (place - fixed) / job.recipe.process->scale;
}

/// Returns which voxels the part covers in part.
std::vector<std::uint8_t> covered_voxels(const ServedJob& job, const VoxelGrid& grid,
                                         const CancelToken* cancel) {
    const RowBand page = voxel_page(grid);
    std::vector<std::uint8_t> covered(grid.voxels());
    parallel_for(static_cast<std::size_t>(grid.size.z), [&](std::size_t k) {
        stop_if_cancelled(cancel);
        SliceContext context;
        const double z = grid.middle({0, 0, static_cast<int>(k)}).z;
        std::ranges::copy(grey_page(context.slice(*job.job().part, z), page, true),
                          covered.begin() + static_cast<std::ptrdiff_t>(k * grid.plane()));
    });
    return covered;
}

/// Marks the voxels within reach of marked ones, along one axis.
void spread(std::vector<std::uint8_t>& marks, const VoxelGrid& grid, int axis) {
    const std::vector<std::uint8_t> before = marks;
    parallel_for(grid.size.z, [&](int z) {
        for (int y = 0; y < grid.size.y; ++y) {
            for (int x = 0; x < grid.size.x; ++x) {
                glm::ivec3 at(x, y, z);
                std::uint8_t& mark = marks[grid.place(at)];
                const int here = at[axis];
                for (int i = std::max(0, here - reach); i <= std::min(grid.size[axis] - 1, here + reach);
                     ++i) {
                    at[axis] = i;
                    mark = std::max(mark, before[grid.place(at)]);
                }
            }
        }
    });
}

std::vector<VoxelBrick> bricks_of(const ServedJob& job, const VoxelGrid& grid) {
    std::vector<VoxelBrick> bricks;
    for (int z = 0; z < grid.size.z; z += brick_edge) {
        for (int y = 0; y < grid.size.y; y += brick_edge) {
            for (int x = 0; x < grid.size.x; x += brick_edge) {
                const glm::ivec3 first(x, y, z), end = glm::min(first + brick_edge, grid.size);
                bricks.push_back(
                    {first,
                     end,
                     {designed_place(job, grid.middle(first)), designed_place(job, grid.middle(end - 1))}});
            }
        }
    }
    return bricks;
}

/// Calls visit(at) for the marked voxels of a brick.
template <typename Visit>
void for_marked(const VoxelBrick& brick, const VoxelGrid& grid, const std::vector<std::uint8_t>& marks,
                Visit visit) {
    for (int z = brick.first.z; z < brick.end.z; ++z) {
        for (int y = brick.first.y; y < brick.end.y; ++y) {
            for (int x = brick.first.x; x < brick.end.x; ++x)
                if (marks[grid.place({x, y, z})] > 0) visit(glm::ivec3(x, y, z));
        }
    }
}

}  // namespace

std::string part_samples(const ServedJob& job, int longest, const PartSampling& sampling,
                         const nlohmann::ordered_json& more, const PassControl& control) {
    if (job.parts > 1)
        throw HttpError(400, "several parts stand on the plate; accepted: one, for what its places say");
    const VoxelGrid grid = voxel_grid(job.job().bounds, longest);
    nlohmann::ordered_json head = grid_head(grid, sampling.channels);
    head.update(more);
    std::string bytes = headed(head);
    const std::size_t first = bytes.size(), channels = static_cast<std::size_t>(sampling.channels);
    bytes.resize(first + channels * grid.voxels());
    ThreadArena arena(control.threads);
    arena.execute([&] {
        std::vector<std::uint8_t> marks = covered_voxels(job, grid, control.cancel);
        for (const int axis : {0, 1, 2}) spread(marks, grid, axis);
        const std::vector<VoxelBrick> bricks = bricks_of(job, grid);
        parallel_for(bricks.size(), [&](std::size_t i) {
            stop_if_cancelled(control.cancel);
            PlaceBytes sample;
            std::vector<std::uint8_t> found(channels);
            for_marked(bricks[i], grid, marks, [&](glm::ivec3 at) {
                if (!sample) sample = sampling.in_brick(bricks[i]);
                sample(designed_place(job, grid.middle(at)), found);
                std::ranges::copy(
                    found, bytes.begin() + static_cast<std::ptrdiff_t>(first + channels * grid.place(at)));
            });
        });
    });
    return bytes;
}

}  // namespace lamella
