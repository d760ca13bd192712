// Distances of a foam of beams through bricks, its slices through strips.
#include "procedural/beam_foam.h"

#include <cmath>

#include "engine/slice_context.h"
#include "procedural/beam_strips.h"

namespace lamella {
namespace {

constexpr double cells_per_strip = 8192;
constexpr double most_strips = 256;

bool finite(dvec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

double BeamFoam::value(dvec3 p) const {
    if (!finite(p)) return std::numeric_limits<double>::quiet_NaN();
    const BrickSize size = brick_size(p);
    const double side = size.side;
    const dvec3 index = glm::floor(p / side);
    const PlaceKey key{static_cast<std::int64_t>(index.x), static_cast<std::int64_t>(index.y),
                       static_cast<std::int64_t>(index.z), size.level, 0};
    const auto brick = bricks_.find_or_make(key, p.z, [&] {
        return DistanceBrick({index * side, (index + 1.0) * side},
                             [this](const Box& box) { return beams_touching(box); });
    });
    return brick->distance(p);
}

/// Any brick about the point is exact; one no larger than twice the smallest cell about it is quick to make
/// and to ask.
BeamFoam::BrickSize BeamFoam::brick_size(dvec3 p) const {
    BrickSize size{0, cells_.hi};
    while (size.side > cells_.lo) {
        const dvec3 lo = glm::floor(p / size.side) * size.side;
        if (size.side <= 2 * cell_->range(grown(Box{lo, lo + size.side}, size.side)).lo) break;
        size = {size.level + 1, size.side / 2};
    }
    return size;
}

Interval BeamFoam::range(const Box& box) const {
    const dvec3 center = box.center();
    const double center_value = value(center);
    if (!std::isfinite(center_value)) return {-infinity, infinity};
    // The value is 1-Lipschitz. Inside, a beam's axis is the deepest place.
    const double radius = glm::length(box.hi - center);
    return {std::max(center_value - radius, -largest_radius_), center_value + radius};
}

const SliceField& BeamFoam::slice(SliceContext& context, double z) const {
    const dvec2 cells = region_.rect().size() / cells_.lo;
    const double strips = std::floor(std::min(cells.x * cells.y / cells_per_strip, most_strips));
    return context.make<BeamStrips>(
        *this, [this](const Box& box) { return beams_touching(box); }, region_.rect(),
        std::max(static_cast<int>(strips), 1), z);
}

std::vector<Beam> BeamFoam::beams_at(double z) const {
    return beams_touching({{region_.lo.x, region_.lo.y, z}, {region_.hi.x, region_.hi.y, z}});
}

}  // namespace lamella
