// Closed forms of the hull of three balls: its distance, its wedge, and its intersection with a line.
#include "engine/solids/round_triangle.h"

namespace lamella {
namespace {

/// Squares of the least sine between edges, and of the least cosine between a tangent plane and the face, for
/// which the face counts. Below them the shape differs from the union of its edge beams by less than rounding
/// errors.
constexpr double min_sine_squared = 1e-18;
constexpr double min_cosine_squared = 1e-12;

/// The face and its two tangent planes, whose unit normals are tilt + cosine * normal and tilt - cosine *
/// normal. The tilt lies in the face; in its direction the radius falls by the tilt's length per mm.
struct Face {
    dvec3 normal{0}, tilt{0};
    double cosine = 0;
};

std::optional<Face> face_of(const RoundTriangle& t) {
    const dvec3 u = t.corners[1] - t.corners[0], v = t.corners[2] - t.corners[0];
    const dvec3 c = glm::cross(u, v);
    const double area = glm::dot(c, c);
    if (!(area > min_sine_squared * glm::dot(u, u) * glm::dot(v, v))) return std::nullopt;
    Face face;
    face.normal = c / std::sqrt(area);
    const double du = t.radii[0] - t.radii[1], dv = t.radii[0] - t.radii[2];
    face.tilt = (glm::cross(v, c) * du + glm::cross(c, u) * dv) / area;
    const double square = 1 - glm::dot(face.tilt, face.tilt);
    if (!(square > min_cosine_squared)) return std::nullopt;
    face.cosine = std::sqrt(square);
    return face;
}

/// Returns the signed distance of a point in the face from the edge that starts at a corner (positive
/// inside), times the edge's length.
double inside_edge(const RoundTriangle& t, const Face& face, std::size_t corner, dvec3 p) {
    const dvec3 edge = t.corners[(corner + 1) % 3] - t.corners[corner];
    return glm::dot(glm::cross(edge, p - t.corners[corner]), face.normal);
}

/// Sets a half-space of the wedge: bounded `beyond` mm outside of a point.
void set_plane(Wedge& w, std::size_t k, dvec3 normal, dvec3 point, double beyond) {
    w.normals[k] = normal;
    w.limits[k] = glm::dot(normal, point - w.origin) + beyond;
}

void set_side(Wedge& w, std::size_t k, dvec3 edge, dvec3 up, dvec3 point) {
    const dvec3 side = glm::cross(edge, up);
    set_plane(w, k, side / std::sqrt(glm::dot(side, side)), point, 0);
}

dvec3 center(const RoundTriangle& t) { return (t.corners[0] + t.corners[1] + t.corners[2]) / 3.0; }

}  // namespace

double signed_distance(const RoundTriangle& t, dvec3 p) {
    // The distance is the least of |p - x| - r(x) over the triangle's points x, a convex function. In the
    // face's plane the minimum is where p - x is normal to a tangent plane. If that point is outside the
    // triangle, the minimum is on an edge that it lies outside of.
    if (const auto face = face_of(t)) {
        const double along = glm::dot(face->normal, p - t.corners[0]), height = std::abs(along);
        const dvec3 foot = p - face->normal * along, x = foot - face->tilt * (height / face->cosine);
        const double inside[3] = {inside_edge(t, *face, 0, x), inside_edge(t, *face, 1, x),
                                  inside_edge(t, *face, 2, x)};
        if (inside[0] >= 0 && inside[1] >= 0 && inside[2] >= 0)
            return glm::dot(face->tilt, foot - t.corners[0]) + face->cosine * height - t.radii[0];
        double least = infinity;
        for (std::size_t i = 0; i < 3; ++i) {
            if (inside[i] < 0) least = std::min(least, signed_distance(edge_beam(t, i), p));
        }
        return least;
    }
    return std::min(signed_distance(edge_beam(t, 0), p),
                    std::min(signed_distance(edge_beam(t, 1), p), signed_distance(edge_beam(t, 2), p)));
}

std::optional<Interval> cut(const RoundTriangle& t, dvec3 p, dvec3 direction) {
    // The union of the pieces is convex, so the line meets it in the hull of the line's intervals in the
    // pieces.
    Interval inside;
    for (std::size_t i = 0; i < 3; ++i) {
        if (const auto part = cut(edge_beam(t, i), p, direction)) inside = unite(inside, *part);
    }
    if (const auto between = wedge(t)) {
        if (const auto part = cut(*between, p, direction)) inside = unite(inside, *part);
    }
    if (inside.empty()) return std::nullopt;
    return inside;
}

Box bounds(const RoundTriangle& t) {
    Box box;
    for (std::size_t i = 0; i < 3; ++i) {
        box = unite(box, {t.corners[i] - t.radii[i], t.corners[i] + t.radii[i]});
    }
    return box;
}

std::optional<Wedge> wedge(const RoundTriangle& t) {
    const auto face = face_of(t);
    if (!face) return std::nullopt;
    Wedge w;
    w.origin = center(t);
    const dvec3 front = face->tilt + face->normal * face->cosine,
                back = face->tilt - face->normal * face->cosine;
    set_plane(w, 0, front, t.corners[0], t.radii[0]);
    set_plane(w, 1, back, t.corners[0], t.radii[0]);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        const dvec3 from = t.corners[i] + face->tilt * t.radii[i];
        const dvec3 to = t.corners[next] + face->tilt * t.radii[next];
        set_side(w, 2 + i, to - from, face->normal, from);
        w.corners[i] = t.corners[i] + front * t.radii[i];
        w.corners[3 + i] = t.corners[i] + back * t.radii[i];
    }
    return w;
}

std::optional<Wedge> inner_wedge(const RoundTriangle& t, double front) {
    const auto face = face_of(t);
    if (!face) return std::nullopt;
    Wedge w;
    w.origin = center(t);
    const dvec3 back = face->tilt - face->normal * face->cosine;
    set_plane(w, 0, face->normal, t.corners[0], front);
    set_plane(w, 1, back, t.corners[0], t.radii[0]);
    for (std::size_t i = 0; i < 3; ++i) {
        const dvec3 corner = t.corners[i], edge = t.corners[(i + 1) % 3] - corner;
        set_side(w, 2 + i, edge, -back, corner);
        w.corners[i] = corner - back * (front / face->cosine);
        w.corners[3 + i] = corner + back * t.radii[i];
    }
    return w;
}

std::optional<Interval> cut(const Wedge& wedge, dvec3 p, dvec3 direction) {
    Interval inside{-infinity, infinity};
    for (std::size_t k = 0; k < wedge.normals.size(); ++k) {
        const double slope = glm::dot(wedge.normals[k], direction);
        const double room = wedge.limits[k] - glm::dot(wedge.normals[k], p - wedge.origin);
        if (slope > 0) {
            inside.hi = std::min(inside.hi, room / slope);
        } else if (slope < 0) {
            inside.lo = std::max(inside.lo, room / slope);
        } else if (room < 0) {
            return std::nullopt;
        }
    }
    if (inside.empty()) return std::nullopt;
    return inside;
}

}  // namespace lamella
