// SurfaceTracer: traces the curves in which flat polygons meet a body's surface, for a surface frame to
// follow.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "engine/field/field.h"

namespace lamella {

/// Orders points lexicographically by x, y, z, and pairs of points by the first, then the second.
struct PlaceOrder {
    bool operator()(dvec3 a, dvec3 b) const {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    }
    bool operator()(const std::pair<dvec3, dvec3>& a, const std::pair<dvec3, dvec3>& b) const {
        return a.first == b.first ? (*this)(a.second, b.second) : (*this)(a.first, b.first);
    }
};

/// A polyline on a body's surface; a closed one ends where it begins.
using SurfaceCurve = std::vector<dvec3>;

/// Traces the curves in which polygons and straight edges meet the surface of a body.
///
/// A polygon is divided into triangles around its centre, and each edge of these into 8 steps. Where the
/// surface may pass, the signs at lattice points decide, and crossings are refined to 1/1000 of a step.
/// Features smaller than a step are missed. An edge meets the surface at exactly the same points as the
/// polygons that share it. Not thread-safe; keeps buffers for reuse.
class SurfaceTracer {
  public:
    static constexpr int steps = 8;  ///< along an edge

    explicit SurfaceTracer(FieldPtr body) : body_(std::move(body)) {}

    /// Appends the curves in a flat convex polygon: closed ones, and those that end at its edges. Their
    /// direction has no meaning.
    void trace(std::span<const dvec3> ring, std::vector<SurfaceCurve>& curves);
    /// Returns the parts of the edge from a to b that lie inside the body, as points: alternately where the
    /// edge enters and where it leaves. An end of the edge that lies inside counts as well.
    std::vector<dvec3> inside(dvec3 a, dvec3 b);
    /// Returns whether a point lies inside the body; cheaper than a distance.
    bool holds(dvec3 p) const { return body_->value_within(p, sign_only) < 0; }
    /// Returns the surface crossing between two points on opposite sides; the same point for (p, q) and (q,
    /// p).
    dvec3 crossing(dvec3 p, dvec3 q) const;
    /// On which side of the surface a box certainly lies; `both` if neither is certain.
    enum class Side : std::uint8_t { inside, outside, both };
    Side side_of(const Box& box) const;

    const Field& body() const { return *body_; }

  private:
    static constexpr double sign_only = 1e-9;  // mm; a limit for queries of the sign only
    struct Segment {
        dvec3 a, b;
    };
    /// A point of the triangle's lattice: steps from corner 0 towards corners 1 and 2.
    struct Place {
        int i, j;
    };
    dvec3 at(Place place) const;
    bool inside(Place place);
    bool clear(const Box& box) const;
    std::vector<dvec3> find_inside(dvec3 a, dvec3 b) const;
    void divide(Place corner, int size);
    void cut(Place a, Place b, Place c);
    void link(std::vector<SurfaceCurve>& curves);

    FieldPtr body_;
    std::array<dvec3, 3> triangle_{};
    std::vector<std::int8_t> inside_;  ///< by point of the triangle's lattice; negative: not evaluated yet
    std::vector<Segment> segments_;
    /// A cache of edges, which several cells share.
    std::map<std::pair<dvec3, dvec3>, std::vector<dvec3>, PlaceOrder> edges_;
};

/// Simplifies a curve: drops points within `tolerance` (mm) of the lines between those kept (Douglas and
/// Peucker 1973). Keeps the first and last point; of a closed curve also the point farthest from them.
SurfaceCurve simplified(const SurfaceCurve& curve, double tolerance);

}  // namespace lamella
