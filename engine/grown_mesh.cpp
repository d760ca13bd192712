// Growing: per triangle a prism (its points moved up to a distance along the normal), per edge a capsule.
#include "engine/grown_mesh.h"

#include "engine/line_frame.h"
#include "engine/slice_context.h"

namespace lamella {
namespace {

/// A reflex edge whose two prisms leave a wedge thinner than this is closed by rounding anyway, mm.
constexpr double least_wedge = 1e-7;

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

/// Whether points inside the solid can have their nearest surface point on the edge between two neighbours.
bool is_reflex(const TriangleMesh& mesh, const std::vector<dvec3>& normals, const HalfEdge& a,
               const HalfEdge& b, double distance) {
    const dvec3 na = normals[a.triangle], nb = normals[b.triangle];
    if (na == dvec3(0) || nb == dvec3(0)) return true;
    const dvec3 n = glm::cross(na, nb);
    const double sine = std::sqrt(glm::dot(n, n));
    const bool faces_away = glm::dot(na, nb) < 0;
    if (!faces_away && sine * distance < least_wedge) return false;
    const dvec3 edge = mesh.vertices[a.low];
    return glm::dot(na, mesh.vertices[opposite_corner(mesh, b)] - edge) > 0 ||
           glm::dot(nb, mesh.vertices[opposite_corner(mesh, a)] - edge) > 0;
}

}  // namespace

GrownMesh::GrownMesh(std::shared_ptr<const SolidMesh> solid, double distance, bool inside_only)
    : solid_(std::move(solid)), distance_(distance) {
    const TriangleMesh& mesh = solid_->mesh;
    std::vector<Interval> heights;
    for (const auto& t : mesh.triangles) {
        const dvec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
        const dvec3 n = glm::cross(b - a, c - a);
        const double area = std::sqrt(glm::dot(n, n));
        normals_.push_back(area > 0 ? n / area : dvec3(0));
        heights.push_back(
            {std::min(a.z, std::min(b.z, c.z)) - distance, std::max(a.z, std::max(b.z, c.z)) + distance});
    }
    triangles_by_height_ = IntervalIndex(heights, std::vector<double>(heights.size(), 0.0));

    const bool only_reflex = inside_only && solid_->oriented_manifold;
    const std::vector<HalfEdge> halves = half_edges(mesh);
    heights.clear();
    for (std::size_t k = 0; k < halves.size();) {
        std::size_t end = k + 1;
        while (end < halves.size() && halves[end].low == halves[k].low && halves[end].high == halves[k].high)
            ++end;
        const bool kept =
            !only_reflex || end - k != 2 || is_reflex(mesh, normals_, halves[k], halves[k + 1], distance);
        if (kept) {
            const double a = mesh.vertices[halves[k].low].z, b = mesh.vertices[halves[k].high].z;
            edges_.emplace_back(halves[k].low, halves[k].high);
            heights.push_back({std::min(a, b) - distance, std::max(a, b) + distance});
        }
        k = end;
    }
    edges_by_height_ = IntervalIndex(heights, std::vector<double>(heights.size(), 0.0));
}

void GrownMesh::near_plane(double z, std::vector<std::uint32_t>& triangles,
                           std::vector<Beam>& capsules) const {
    triangles_by_height_.query({z, z}, triangles);
    std::vector<std::uint32_t> edges;
    edges_by_height_.query({z, z}, edges);
    capsules.clear();
    for (const std::uint32_t e : edges) {
        capsules.push_back(
            {mesh().vertices[edges_[e].first], distance_, mesh().vertices[edges_[e].second], distance_});
    }
}

void GrownMesh::collect_prism(std::uint32_t triangle, double z, const RowBand& band,
                              RunCollector& runs) const {
    const dvec3 n = normals_[triangle];
    if (n == dvec3(0)) return;
    const auto& t = mesh().triangles[triangle];
    const dvec3 corner[3] = {mesh().vertices[t[0]], mesh().vertices[t[1]], mesh().vertices[t[2]]};
    const int along = band.axis == Axis::x ? 0 : 1, across = 1 - along;
    const double low = std::min(corner[0][across], std::min(corner[1][across], corner[2][across]));
    const double high = std::max(corner[0][across], std::max(corner[1][across], corner[2][across]));
    const double reach = distance_ * std::sqrt(std::max(1 - n.z * n.z, 0.0));
    const LineRange lines = lines_across(band, {low - reach, high + reach});
    if (lines.first >= lines.last) return;

    const dvec3 center = (corner[0] + corner[1] + corner[2]) / 3.0;
    const double dz = z - center.z;
    PrismInPlane p;
    const auto set = [&](std::size_t k, dvec3 normal, double limit) {
        p.nx[k] = static_cast<float>(normal[along]);
        p.ny[k] = static_cast<float>(normal[across]);
        p.limit[k] = static_cast<float>(limit - normal.z * dz);
    };
    const double height = glm::dot(n, corner[0] - center);
    set(0, n, height + distance_);
    set(1, -n, distance_ - height);
    for (std::size_t e = 0; e < 3; ++e) {
        const dvec3 side = glm::cross(corner[(e + 1) % 3] - corner[e], n);
        const double l = std::sqrt(glm::dot(side, side));
        set(2 + e, side / l, glm::dot(side / l, corner[e] - center));
    }
    const auto out = runs.add(lines.first, lines.last - lines.first);
    prism_rows(line_frame(band, lines.first, dvec2(center)), p, lines.last - lines.first, out.begin, out.end);
}

GrownMeshSlice::GrownMeshSlice(const Field& field, const GrownMesh& grown, double z)
    : SampledSlice(field, z), grown_(grown), z_(z) {
    std::vector<Beam> capsules;
    grown.near_plane(z, triangles_, capsules);
    capsules_ = std::make_unique<BeamRows>(capsules, z);
    std::vector<Rect> prisms;
    for (const std::uint32_t triangle : triangles_) {
        const auto& t = grown.mesh().triangles[triangle];
        Box box;
        for (const std::uint32_t v : t) box.include(grown.mesh().vertices[v]);
        prisms.push_back(lamella::grown(box.rect(), grown.distance()));
    }
    prisms_ = PlaneIndex(std::move(prisms));
}

void GrownMeshSlice::spans(const RowBand& band, Scratch& scratch, SpanRows& out) const {
    std::vector<std::uint32_t> items;
    prisms_.query(band, items);
    scratch.collector.clear();
    for (const std::uint32_t i : items) grown_.collect_prism(triangles_[i], z_, band, scratch.collector);
    capsules_->collect(band, scratch.collector);
    scratch.collector.merge(band, out);
}

}  // namespace lamella
