// Distances of a foam through bricks, its slices through strips.
#include "procedural/piece_foam.h"

#include <cmath>

#include "engine/slice_context.h"
#include "procedural/plane_strips.h"

namespace lamella {
namespace {

constexpr double cells_per_strip = 8192;
constexpr double most_strips = 256;

bool finite(dvec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

PlanePieces sorted_by_kind(std::vector<Beam> beams) { return {std::move(beams), {}}; }

PlanePieces sorted_by_kind(const std::vector<FoamPiece>& pieces) {
    PlanePieces sorted;
    for (const FoamPiece& piece : pieces) {
        if (const auto* beam = std::get_if<Beam>(&piece)) sorted.beams.push_back(*beam);
        if (const auto* wall = std::get_if<RoundTriangle>(&piece)) sorted.walls.push_back(*wall);
    }
    return sorted;
}

}  // namespace

template <typename Piece>
double PieceFoam<Piece>::value(dvec3 p) const {
    if (!finite(p)) return std::numeric_limits<double>::quiet_NaN();
    const BrickSize size = brick_size(p);
    const double side = size.side;
    const dvec3 index = glm::floor(p / side);
    const PlaceKey key{static_cast<std::int64_t>(index.x), static_cast<std::int64_t>(index.y),
                       static_cast<std::int64_t>(index.z), size.level, 0};
    const auto brick = bricks_.find_or_make(key, p.z, [&] {
        return PieceBrick<Piece>({index * side, (index + 1.0) * side},
                                 [this](const Box& box) { return pieces_touching(box); });
    });
    return brick->distance(p);
}

/// Any brick about the point is exact; one no larger than twice the smallest cell about it is quick to make
/// and to ask.
template <typename Piece>
typename PieceFoam<Piece>::BrickSize PieceFoam<Piece>::brick_size(dvec3 p) const {
    BrickSize size{0, cells_.hi};
    while (size.side > cells_.lo) {
        const dvec3 lo = glm::floor(p / size.side) * size.side;
        if (size.side <= 2 * cell_->range(grown(Box{lo, lo + size.side}, size.side)).lo) break;
        size = {size.level + 1, size.side / 2};
    }
    return size;
}

template <typename Piece>
Interval PieceFoam<Piece>::range(const Box& box) const {
    const dvec3 center = box.center();
    const double center_value = value(center);
    if (!std::isfinite(center_value)) return {-infinity, infinity};
    // The value is 1-Lipschitz. Inside, a piece's axis is the deepest place.
    const double radius = glm::length(box.hi - center);
    return {std::max(center_value - radius, -largest_radius_), center_value + radius};
}

template <typename Piece>
const SliceField& PieceFoam<Piece>::slice(SliceContext& context, double z) const {
    const dvec2 cells = region_.rect().size() / cells_.lo;
    const double strips = std::floor(std::min(cells.x * cells.y / cells_per_strip, most_strips));
    return context.make<PlaneStrips>(
        *this, [this](const Box& box) { return sorted_by_kind(pieces_touching(box)); }, region_.rect(),
        std::max(static_cast<int>(strips), 1), z);
}

template class PieceFoam<Beam>;
template class PieceFoam<FoamPiece>;

}  // namespace lamella
