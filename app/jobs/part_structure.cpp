// Samples how far places lie within the skin, beside which beams of a foam and in which regions.
#include "app/jobs/part_structure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/http/http_server.h"
#include "app/jobs/part_samples.h"
#include "engine/solids/beam.h"
#include "recipe/build/build_skin.h"

namespace lamella {

namespace {

bool has_frame(const ServedJob& job) {
    return job.recipe.frame && job.built.foam && job.built.foam->beams_touching;
}

bool has_skin_above(const ServedJob& job) { return job.recipe.skin && job.built.foam; }

/// Returns how far below the body's surface the skin reaches at a place, mm.
double skin_depth(const ServedJob& job, dvec3 place) {
    const SkinRecipe& skin = *job.recipe.skin;
    if (skin.side == SkinSide::outside) return 0;
    const double thickness = job.built.skin ? job.built.skin->made->at(place) : skin.thickness.number();
    return skin.side == SkinSide::centred ? thickness / 2 : thickness;
}

std::vector<FieldPtr> solid_regions(const BuiltJob& built) {
    std::vector<FieldPtr> solid;
    for (const BuiltRegion& region : built.regions.list)
        if (region.make == RegionMake::solid) solid.push_back(region.field);
    return solid;
}

/// A distance, positive inside, as a byte.
std::uint8_t byte_of(double inside, double voxel) {
    const double share = std::clamp(inside / (2 * voxel), -1.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(128 + 127 * (std::isnan(share) ? -1 : share)));
}

/// Beams of a foam near a brick: those of the frame, whose axes follow the body's surface, and the others.
struct BeamsBeside {
    std::vector<Beam> frame, others;

    /// Returns by how much the frame is nearer than other beams, mm.
    double frame_is_nearer(dvec3 place, double most) const {
        const auto nearest = [&](const std::vector<Beam>& beams) {
            double least = 2 * most;
            for (const Beam& beam : beams) least = std::min(least, signed_distance(beam, place));
            return least;
        };
        return frame.empty() ? -most : nearest(others) - nearest(frame);
    }
};

BeamsBeside beams_beside(const BuiltJob& built, const Box& box, double beside) {
    BeamsBeside found;
    for (const Beam& beam : built.foam->beams_touching({box.lo - beside, box.hi + beside})) {
        const double off = std::min(beam.ra, beam.rb) / 2;
        const bool follows = std::ranges::all_of(
            std::array{beam.a, beam.b, 0.5 * (beam.a + beam.b)},
            [&](dvec3 p) { return std::abs(built.body->value_within(p, 2 * off)) <= off; });
        (follows ? found.frame : found.others).push_back(beam);
    }
    return found;
}

}  // namespace

std::vector<std::string> structure_parts(const ServedJob& job) {
    if (job.parts > 1) return {};
    std::vector<std::string> parts;
    if (has_skin_above(job)) parts.emplace_back("skin");
    if (has_frame(job)) parts.emplace_back("frame");
    if (!solid_regions(job.built).empty()) parts.emplace_back("solid");
    parts.emplace_back(job.built.foam ? "foam" : job.recipe.skin ? "skin" : "body");
    if (job.job().supports) parts.emplace_back("supports");
    if (parts.size() < 2) return {};
    return parts;
}

std::string structure_volume(const ServedJob& job, int longest, const PassControl& control) {
    const std::vector<std::string> parts = structure_parts(job);
    if (parts.empty())
        throw HttpError(
            400,
            "nothing can be told apart; accepted: one part with a skin, a frame, solid regions or "
            "supports besides its foam or body");
    const BuiltJob& built = job.built;
    const double voxel = voxel_grid(built.designed.bounds, longest).voxel;
    const bool is_skinned = has_skin_above(job);
    const bool is_framed = has_frame(job), is_closed = is_skinned && !has_cut_skin(job.recipe);
    const std::vector<FieldPtr> solid = solid_regions(built);
    const auto in_brick = [&](const VoxelBrick& brick) -> PlaceBytes {
        const BeamsBeside beams = is_framed ? beams_beside(built, brick.box, 2 * voxel) : BeamsBeside();
        return [&, beams](dvec3 place, std::span<std::uint8_t> bytes) {
            const double most = 2 * voxel;
            const double skin = is_skinned ? built.body->value(place) + skin_depth(job, place) : -most;
            double frame = is_framed ? beams.frame_is_nearer(place, most) : -most;
            if (is_closed) frame = std::min(frame, -skin);
            double region = -most;
            for (const FieldPtr& one : solid) region = std::max(region, -one->value_within(place, most));
            bytes[0] = byte_of(skin, voxel);
            bytes[1] = byte_of(frame, voxel);
            bytes[2] = byte_of(region, voxel);
        };
    };
    return part_samples(job, longest, {3, in_brick}, {{"parts", parts}}, control);
}

}  // namespace lamella
