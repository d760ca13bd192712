// PieceFoam: the common base of foams as fields. Computes distances, ranges and slices from a query for
// pieces in a box.
#pragma once

#include <cmath>
#include <vector>

#include "engine/field/grading.h"
#include "engine/field/slice_context.h"
#include "procedural/foam/distance_brick.h"
#include "procedural/foam/piece_slabs.h"
#include "procedural/voronoi/cell_cache.h"

namespace lamella {

/// An infinite union of pieces, given by a query for the pieces that touch a box.
///
/// Piece must have signed_distance(piece, p) and put_into(PlanePieces&, piece), found by argument-dependent
/// lookup.
template <typename Piece>
class PieceFoam : public Field {
  public:
    /// Returns every piece that touches the box, once, in canonical order.
    virtual std::vector<Piece> pieces_touching(const Box& box) const = 0;

    /// Returns the minimum of the signed distances to all pieces, mm. Outside it is the exact distance;
    /// inside, its magnitude never exceeds the distance to the surface. NaN at points that are not finite.
    double value(dvec3 p) const override;
    void values(std::span<const dvec3> points, std::span<double> out) const override;
    Interval range(const Box& box) const override;
    Metric metric() const override { return Metric::bound; }
    const SliceField& slice(SliceContext& context, double z) const override;
    /// The region.
    Box bounds() const override { return region_; }

  protected:
    /// `cell` is roughly the spacing of pieces, mm, and lies within `cells` everywhere. No piece is deeper
    /// than `deepest`, mm. `cache_bytes` bounds the memory for distances.
    PieceFoam(const Box& region, GradingPtr cell, Interval cells, double deepest, std::size_t cache_bytes)
        : region_(region),
          cell_(std::move(cell)),
          cells_(cells),
          deepest_(deepest),
          bricks_(cache_bytes),
          slabs_(slab_height_in_cells * cells.lo, strips_of(region, cells.lo)) {}

  private:
    static constexpr double slab_height_in_cells = 0.125;
    static int strips_of(const Box& region, double cell);
    using Brick = PieceBrick<Piece>;
    PlaceKey place_about(dvec3 p) const;
    std::shared_ptr<const Brick> brick_about(dvec3 p) const;
    double side_of(int level) const { return std::ldexp(cells_.hi, -level); }

    Box region_;
    GradingPtr cell_;
    Interval cells_;
    double deepest_;
    mutable CellCache<Brick> bricks_;
    PieceSlabs<Piece> slabs_;
};

template <typename Piece>
double PieceFoam<Piece>::value(dvec3 p) const {
    return is_finite(p) ? brick_about(p)->distance(p) : std::numeric_limits<double>::quiet_NaN();
}

template <typename Piece>
void PieceFoam<Piece>::values(std::span<const dvec3> points, std::span<double> out) const {
    std::shared_ptr<const Brick> brick;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const dvec3 p = points[i];
        if (!is_finite(p)) {
            out[i] = std::numeric_limits<double>::quiet_NaN();
            continue;
        }
        // Every brick that holds a point gives the same distance, so that of the point before may serve.
        if (!brick || !brick->holds(p)) brick = brick_about(p);
        out[i] = brick->distance(p);
    }
}

template <typename Piece>
std::shared_ptr<const PieceBrick<Piece>> PieceFoam<Piece>::brick_about(dvec3 p) const {
    const PlaceKey place = place_about(p);
    return bricks_.find_or_make(place, p.z, [&] {
        const double side = side_of(place.level);
        const dvec3 index(glm::i64vec3(place.x, place.y, place.z));
        return Brick({index * side, (index + 1.0) * side},
                     [this](const Box& box) { return pieces_touching(box); });
    });
}

/// Any brick that contains the point gives the exact distance. One no larger than twice the smallest cell
/// around it is quick to build and to query.
template <typename Piece>
PlaceKey PieceFoam<Piece>::place_about(dvec3 p) const {
    for (int level = 0;; ++level) {
        const double side = side_of(level);
        const dvec3 index = glm::floor(p / side);
        const Box box{index * side, (index + 1.0) * side};
        if (side <= cells_.lo || side <= 2 * cell_->range(grown(box, side)).lo) {
            return {static_cast<std::int64_t>(index.x), static_cast<std::int64_t>(index.y),
                    static_cast<std::int64_t>(index.z), level, 0};
        }
    }
}

template <typename Piece>
Interval PieceFoam<Piece>::range(const Box& box) const {
    const dvec3 center = box.center();
    const double center_value = value(center);
    if (!std::isfinite(center_value)) return {-infinity, infinity};
    // The value is 1-Lipschitz. Inside, it is lowest on the axis of the thickest piece.
    const double radius = glm::length(box.hi - center);
    return {std::max(center_value - radius, -deepest_), center_value + radius};
}

/// Returns the number of strips of a plane, so that each has some thousand cells.
template <typename Piece>
int PieceFoam<Piece>::strips_of(const Box& region, double cell) {
    constexpr double cells_per_strip = 8192, max_strips = 256;
    const dvec2 cells = region.rect().size() / cell;
    return std::max(static_cast<int>(std::min(cells.x * cells.y / cells_per_strip, max_strips)), 1);
}

template <typename Piece>
const SliceField& PieceFoam<Piece>::slice(SliceContext& context, double z) const {
    const auto meeting = [this, z](std::size_t strip, const Rect& rect) {
        return slabs_.at(strip, rect, z, [this](const Box& box) { return pieces_touching(box); });
    };
    return context.make<PlaneStrips>(*this, meeting, region_.rect(), slabs_.strips(), z);
}

}  // namespace lamella
