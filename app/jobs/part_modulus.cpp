// Samples the modulus in and beside the voxels that the part covers: elsewhere nobody sees it.
#include "app/jobs/part_modulus.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/http/http_server.h"
#include "app/jobs/layer_content.h"
#include "app/jobs/voxel_grid.h"
#include "app/reports/grey_page.h"
#include "app/reports/modulus_paint.h"
#include "engine/base/cancel_token.h"
#include "engine/base/parallel.h"
#include "engine/field/slice_context.h"

namespace lamella {

namespace {

/// Returns a place of the job as it was designed, before it was scaled for the machine.
dvec3 designed_place(const ServedJob& job, dvec3 place) {
    if (!job.recipe.process) return place;
    const Box& bounds = job.built.designed.bounds;
    const dvec3 fixed(bounds.center().x, bounds.center().y, bounds.lo.z);
    return fixed + (place - fixed) / job.recipe.process->scale;
}

/// Returns which voxels the part covers in part.
std::vector<std::uint8_t> covered_voxels(const ServedJob& job, const VoxelGrid& grid) {
    const RowBand page = voxel_page(grid);
    std::vector<std::uint8_t> covered(grid.voxels());
    parallel_for(static_cast<std::size_t>(grid.size.z), [&](std::size_t k) {
        SliceContext context;
        const double z = grid.middle({0, 0, static_cast<int>(k)}).z;
        std::ranges::copy(grey_page(context.slice(*job.job().part, z), page, true),
                          covered.begin() + static_cast<std::ptrdiff_t>(k * grid.plane()));
    });
    return covered;
}

bool is_near(const std::vector<std::uint8_t>& covered, const VoxelGrid& grid, glm::ivec3 at) {
    const glm::ivec3 from = glm::max(at - 1, glm::ivec3(0)), to = glm::min(at + 1, grid.size - 1);
    for (int z = from.z; z <= to.z; ++z) {
        for (int y = from.y; y <= to.y; ++y) {
            for (int x = from.x; x <= to.x; ++x)
                if (covered[grid.place({x, y, z})] > 0) return true;
        }
    }
    return false;
}

}  // namespace

std::string modulus_volume(const ServedJob& job, int longest, const PassControl& control) {
    const auto code_at = modulus_codes(job.built, "modulus");
    if (job.parts > 1)
        throw HttpError(400, "several parts stand on the plate; accepted: one, for its modulus");
    const VoxelGrid grid = voxel_grid(job.job().bounds, longest);
    const ModulusReport& report = *job.built.modulus;
    nlohmann::ordered_json head = grid_head(grid, 1);
    head["scale"] = {
        {"lo_mpa", report.predicted.lo}, {"hi_mpa", report.predicted.hi}, {"is_asked", report.is_asked}};
    std::string bytes = headed(head);
    const std::size_t first = bytes.size();
    bytes.resize(first + grid.voxels());
    ThreadArena arena(control.threads);
    arena.execute([&] {
        const std::vector<std::uint8_t> covered = covered_voxels(job, grid);
        parallel_for(grid.size.z, [&](int z) {
            stop_if_cancelled(control.cancel);
            for (int y = 0; y < grid.size.y; ++y) {
                for (int x = 0; x < grid.size.x; ++x) {
                    if (!is_near(covered, grid, {x, y, z})) continue;
                    bytes[first + grid.place({x, y, z})] =
                        static_cast<char>(code_at(designed_place(job, grid.middle({x, y, z}))));
                }
            }
        });
    });
    return bytes;
}

}  // namespace lamella
