// Where flat polygons meet a body's surface: the curves that a surface frame follows.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "engine/field/field.h"

namespace lamella {

/// Orders points by x, y, z, and pairs of them by the first, then the second.
struct PlaceOrder {
    bool operator()(dvec3 a, dvec3 b) const {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    }
    bool operator()(const std::pair<dvec3, dvec3>& a, const std::pair<dvec3, dvec3>& b) const {
        return a.first == b.first ? (*this)(a.second, b.second) : (*this)(a.first, b.first);
    }
};

/// A curve on a body's surface, as points joined by straight lines; a closed one ends where it begins.
using SurfaceCurve = std::vector<dvec3>;

/// Traces the curves in which polygons and straight edges meet the surface of a body.
///
/// A polygon is divided from its middle into triangles, and each edge of these into 8; where the surface may
/// pass, the signs at corners decide, and crossings are narrowed to 1/1000 of a step. What is smaller than a
/// step is not seen. An edge meets the surface at the very points where the polygons that share it do. Not
/// thread-safe; keeps buffers for reuse.
class SurfaceTracer {
  public:
    static constexpr int steps = 8;  ///< along an edge

    explicit SurfaceTracer(FieldPtr body) : body_(std::move(body)) {}

    /// Appends the curves in a flat convex polygon: closed ones, and those that end at its edges. Which way
    /// round a curve is given means nothing.
    void trace(std::span<const dvec3> ring, std::vector<SurfaceCurve>& curves);
    /// The parts of the edge from a to b that lie inside the body, by their ends: alternately where it is
    /// entered and left. Beginning and end of the edge count when they lie inside.
    std::vector<dvec3> inside(dvec3 a, dvec3 b);
    /// Whether a point lies inside the body; sooner known than how deep.
    bool holds(dvec3 p) const { return body_->value_within(p, sign_only) < 0; }
    /// Where the surface crosses between two points on its two sides; the same point whichever comes first.
    dvec3 crossing(dvec3 p, dvec3 q) const;
    /// Whether the box surely lies on one side of the surface.
    enum class Side : std::uint8_t { inside, outside, both };
    Side side_of(const Box& box) const;

    const Field& body() const { return *body_; }

  private:
    static constexpr double sign_only = 1e-9;  // mm, a distance that no question is about
    struct Segment {
        dvec3 a, b;
    };
    /// A point of the triangle's lattice: steps from its corner 0 towards corners 1 and 2.
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
    std::vector<std::int8_t> inside_;  ///< of the triangle's lattice, below zero where not asked yet
    std::vector<Segment> segments_;
    /// What is known of edges, which several cells share.
    std::map<std::pair<dvec3, dvec3>, std::vector<dvec3>, PlaceOrder> edges_;
};

/// The curve without points that lie within `tolerance` (mm) of the lines between those kept (Douglas and
/// Peucker 1973). The first and the last one are kept; of a closed curve also the farthest from them.
SurfaceCurve simplified(const SurfaceCurve& curve, double tolerance);

}  // namespace lamella
