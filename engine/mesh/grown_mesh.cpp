// Dilation: one wedge per triangle, one beam per kept edge.
#include "engine/mesh/grown_mesh.h"

#include "engine/field/slice_context.h"
#include "engine/mesh/round_triangle_tree.h"

namespace lamella {
namespace {

/// If the gap between an edge's two wedges is thinner than this, mm, rounding closes it.
constexpr double min_gap = 1e-7;
/// How far an inner wedge extends in front of its face, mm: enough that its runs meet the body's despite
/// rounding.
constexpr double overlap = 0.01;
/// A detour over another point counts only if it is shorter by this share of the radius.
constexpr double clearly_shorter = 1e-6;
/// Triangles smaller than this are tested at their corners only.
constexpr double large_in_radii = 0.25;

struct HalfEdge {
    std::uint32_t low, high;  ///< corners, low < high
    std::uint32_t triangle;
    bool operator<(const HalfEdge& o) const {
        return low != o.low ? low < o.low : high != o.high ? high < o.high : triangle < o.triangle;
    }
};

std::vector<HalfEdge> half_edges(const TriangleMesh& mesh) {
    std::vector<HalfEdge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& c = mesh.triangles[t];
        for (std::size_t e = 0; e < 3; ++e) {
            const std::uint32_t u = c[e], v = c[(e + 1) % 3];
            edges.push_back({std::min(u, v), std::max(u, v), t});
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

std::uint32_t opposite_corner(const TriangleMesh& mesh, const HalfEdge& edge) {
    for (const std::uint32_t v : mesh.triangles[edge.triangle]) {
        if (v != edge.low && v != edge.high) return v;
    }
    return edge.low;
}

/// Returns true if points inside the solid can have their nearest surface point on the edge between two
/// neighbours.
bool is_reflex(const TriangleMesh& mesh, const std::vector<dvec3>& normals, const HalfEdge& a,
               const HalfEdge& b, double distance) {
    const dvec3 na = normals[a.triangle], nb = normals[b.triangle];
    if (na == dvec3(0) || nb == dvec3(0)) return true;
    const dvec3 n = glm::cross(na, nb);
    const double sine = std::sqrt(glm::dot(n, n));
    const bool faces_away = glm::dot(na, nb) < 0;
    if (!faces_away && sine * distance < min_gap) return false;
    const dvec3 edge = mesh.vertices[a.low];
    return glm::dot(na, mesh.vertices[opposite_corner(mesh, b)] - edge) > 0 ||
           glm::dot(nb, mesh.vertices[opposite_corner(mesh, a)] - edge) > 0;
}

/// Returns the unit normal of the inner tangent plane of a triangle with radii, seen from inside the solid.
dvec3 inner_normal(const RoundTriangle& t) {
    const auto wedge = inner_wedge(t, 0);
    return wedge ? wedge->normals[1] : dvec3(0);
}

/// Returns true if some plane across the edge between two convex neighbours meets neither inner wedge where
/// the edge's beam is. Seen along the edge, each wedge covers the angles from its face to its inner normal.
bool leaves_gap(const TriangleMesh& mesh, dvec3 na, dvec3 nb, const HalfEdge& a, const HalfEdge& b,
                double radius) {
    if (na == dvec3(0) || nb == dvec3(0)) return true;
    const dvec3 between = na - nb;
    const bool faces_away = glm::dot(na, nb) < 0;
    if (!faces_away && std::sqrt(glm::dot(between, between)) * radius < min_gap) return false;
    const dvec3 edge = mesh.vertices[a.low];
    return glm::dot(between, mesh.vertices[opposite_corner(mesh, b)] - edge) < 0 ||
           glm::dot(-between, mesh.vertices[opposite_corner(mesh, a)] - edge) < 0;
}

std::vector<dvec3> face_normals(const TriangleMesh& mesh) {
    std::vector<dvec3> normals;
    normals.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles) {
        const dvec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
        const dvec3 n = glm::cross(b - a, c - a);
        const double area = std::sqrt(glm::dot(n, n));
        normals.push_back(area > 0 ? n / area : dvec3(0));
    }
    return normals;
}

}  // namespace

GrownMesh::GrownMesh(std::shared_ptr<const SolidMesh> solid, double distance, bool inside_only)
    : solid_(std::move(solid)), distance_(distance), whole_count_(mesh().triangles.size()) {
    index_triangles();
    const bool only_reflex = inside_only && solid_->oriented_manifold;
    const std::vector<dvec3> normals = only_reflex ? face_normals(mesh()) : std::vector<dvec3>();
    keep_edges([&](std::span<const HalfEdge> at_edge) {
        return !only_reflex || at_edge.size() != 2 ||
               is_reflex(mesh(), normals, at_edge[0], at_edge[1], distance_);
    });
}

GrownMesh::GrownMesh(std::shared_ptr<const SolidMesh> solid, std::vector<double> radii,
                     const RoundTriangleTree& tree, bool inside_only)
    : solid_(std::move(solid)), radii_(std::move(radii)), whole_count_(mesh().triangles.size()) {
    index_triangles();
    if (!inside_only || !solid_->oriented_manifold) {
        keep_edges([](std::span<const HalfEdge>) { return true; });
        return;
    }
    find_whole_triangles(tree);
    const std::vector<dvec3> normals = face_normals(mesh());
    keep_edges([&](std::span<const HalfEdge> at_edge) {
        if (at_edge.size() != 2) return true;
        const HalfEdge a = at_edge[0], b = at_edge[1];
        if (whole_[a.triangle] || whole_[b.triangle]) return true;
        const double largest = std::max(radius(a.low), radius(a.high));
        return is_reflex(mesh(), normals, a, b, largest) ||
               leaves_gap(mesh(), inner_normal(triangle(a.triangle)), inner_normal(triangle(b.triangle)), a,
                          b, largest);
    });
}

RoundTriangle GrownMesh::triangle(std::uint32_t number) const {
    const auto& t = mesh().triangles[number];
    return {{mesh().vertices[t[0]], mesh().vertices[t[1]], mesh().vertices[t[2]]},
            {radius(t[0]), radius(t[1]), radius(t[2])}};
}

void GrownMesh::index_triangles() {
    std::vector<Interval> heights;
    heights.reserve(mesh().triangles.size());
    for (const auto& t : mesh().triangles) {
        const double a = mesh().vertices[t[0]].z, b = mesh().vertices[t[1]].z, c = mesh().vertices[t[2]].z;
        const double reach = std::max(radius(t[0]), std::max(radius(t[1]), radius(t[2])));
        // A zero radius dilates nothing; the index never finds an empty interval.
        heights.push_back(
            reach > 0 ? Interval{std::min(a, std::min(b, c)) - reach, std::max(a, std::max(b, c)) + reach}
                      : Interval{});
    }
    triangles_by_height_ = IntervalIndex(heights, std::vector<double>(heights.size(), 0.0));
}

/// Marks the triangles where a detour over another point of the surface undercuts the radius: at one of the
/// corners, or at the centre of a large triangle.
void GrownMesh::find_whole_triangles(const RoundTriangleTree& tree) {
    const auto undercut = [&](dvec3 p, double radius) {
        const double limit = radius * (1 - clearly_shorter);
        return radius > 0 && tree.min_detour(p, limit) < limit;
    };
    const auto undercut_at_centre = [&](const RoundTriangle& t) {
        const double mean = (t.radii[0] + t.radii[1] + t.radii[2]) / 3.0;
        const dvec3 centre = (t.corners[0] + t.corners[1] + t.corners[2]) / 3.0, off = t.corners[0] - centre;
        return glm::dot(off, off) > large_in_radii * large_in_radii * mean * mean && undercut(centre, mean);
    };
    std::vector<bool> at_vertex(mesh().vertices.size());
    for (std::uint32_t v = 0; v < at_vertex.size(); ++v) {
        at_vertex[v] = undercut(mesh().vertices[v], radius(v));
    }
    whole_.assign(mesh().triangles.size(), false);
    whole_count_ = 0;
    for (std::uint32_t k = 0; k < whole_.size(); ++k) {
        const auto& t = mesh().triangles[k];
        whole_[k] = at_vertex[t[0]] || at_vertex[t[1]] || at_vertex[t[2]] || undercut_at_centre(triangle(k));
        whole_count_ += whole_[k];
    }
}

template <typename IsKept>
void GrownMesh::keep_edges(const IsKept& is_kept) {
    const std::vector<HalfEdge> halves = half_edges(mesh());
    std::vector<Interval> heights;
    for (std::size_t k = 0; k < halves.size();) {
        std::size_t end = k + 1;
        while (end < halves.size() && halves[end].low == halves[k].low && halves[end].high == halves[k].high)
            ++end;
        const std::uint32_t low = halves[k].low, high = halves[k].high;
        const double reach = std::max(radius(low), radius(high));
        if (reach > 0 && is_kept(std::span(halves).subspan(k, end - k))) {
            const double a = mesh().vertices[low].z, b = mesh().vertices[high].z;
            edges_.emplace_back(low, high);
            heights.push_back({std::min(a, b) - reach, std::max(a, b) + reach});
        }
        k = end;
    }
    edges_by_height_ = IntervalIndex(heights, std::vector<double>(heights.size(), 0.0));
}

void GrownMesh::near_plane(double z, std::vector<Wedge>& wedges, std::vector<Beam>& beams) const {
    std::vector<std::uint32_t> found;
    triangles_by_height_.query({z, z}, found);
    wedges.clear();
    wedges.reserve(found.size());
    for (const std::uint32_t k : found) {
        const bool inner = !whole_.empty() && !whole_[k];
        if (const auto w = inner ? inner_wedge(triangle(k), overlap) : wedge(triangle(k)))
            wedges.push_back(*w);
    }
    edges_by_height_.query({z, z}, found);
    beams.clear();
    for (const std::uint32_t e : found) {
        const auto [a, b] = edges_[e];
        beams.push_back({mesh().vertices[a], radius(a), mesh().vertices[b], radius(b)});
    }
}

GrownMeshSlice::GrownMeshSlice(const Field& field, const GrownMesh& grown, double z)
    : SampledSlice(field, z) {
    std::vector<Wedge> wedges;
    std::vector<Beam> beams;
    grown.near_plane(z, wedges, beams);
    wedges_ = WedgeRows(wedges, z);
    beams_ = BeamRows(beams, z);
}

void GrownMeshSlice::runs(const RowBand& band, Scratch& scratch, RunRows& out) const {
    scratch.collector.clear();
    wedges_.collect(band, scratch.collector);
    beams_.collect(band, scratch.collector);
    scratch.collector.merge(band, out);
}

}  // namespace lamella
