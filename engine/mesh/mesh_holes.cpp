// Hole filling: walks the boundary, splits off each loop as soon as it closes, and caps it.
#include "engine/mesh/mesh_holes.h"

#include <algorithm>
#include <cmath>

#include "engine/mesh/mesh_edges.h"
#include "engine/mesh/triangulate.h"

namespace lamella {

namespace {

constexpr std::uint32_t no_vertex = 0xffffffffU;

/// The directed edges that must become the boundary of the caps, by start vertex.
class CapEdges {
  public:
    CapEdges(const TriangleMesh& mesh, const MeshEdges& edges)
        : mesh_(mesh), begin_(mesh.vertices.size() + 1, 0), left_(mesh.vertices.size(), 0) {
        each(edges, [&](std::uint32_t start, std::uint32_t) { ++begin_[start + 1]; });
        for (std::size_t v = 0; v + 1 < begin_.size(); ++v) begin_[v + 1] += begin_[v];
        ends_.resize(begin_.back());
        each(edges,
             [&](std::uint32_t start, std::uint32_t end) { ends_[begin_[start] + left_[start]++] = end; });
    }

    bool empty() const { return ends_.empty(); }
    std::uint32_t left(std::uint32_t v) const { return left_[v]; }

    /// Takes the edge out of v with the sharpest turn back, coming from `previous`. At a vertex where several
    /// holes meet this stays at the same hole, and it leaves a slit on the side it was entered from.
    std::uint32_t take(std::uint32_t v, std::uint32_t previous) {
        constexpr std::uint32_t max_looked_at = 64;
        std::uint32_t best = left_[v] - 1;
        if (previous != no_vertex && left_[v] > 1) {
            double best_cosine = -infinity;
            for (std::uint32_t i = 0; i < std::min(left_[v], max_looked_at); ++i) {
                const double c = cosine(previous, v, ends_[begin_[v] + i]);
                if (c > best_cosine) best = i;
                best_cosine = std::max(best_cosine, c);
            }
        }
        std::swap(ends_[begin_[v] + best], ends_[begin_[v] + left_[v] - 1]);
        return ends_[begin_[v] + --left_[v]];
    }

  private:
    template <class Visit>
    static void each(const MeshEdges& edges, const Visit& visit) {
        for (const MeshEdges::Edge& e : edges.edges()) {
            for (std::int64_t n = e.net(); n > 0; --n) visit(e.hi, e.lo);
            for (std::int64_t n = e.net(); n < 0; ++n) visit(e.lo, e.hi);
        }
    }

    double cosine(std::uint32_t a, std::uint32_t v, std::uint32_t b) const {
        const dvec3 p = mesh_.vertices[a] - mesh_.vertices[v];
        const dvec3 q = mesh_.vertices[b] - mesh_.vertices[v];
        const double size = std::sqrt(glm::dot(p, p) * glm::dot(q, q));
        return size > 0.0 ? glm::dot(p, q) / size : 1.0;
    }

    const TriangleMesh& mesh_;
    std::vector<std::uint32_t> begin_, left_, ends_;
};

/// Walks along unused edges; whenever the walk meets itself, calls `found` with the closed loop and removes
/// it.
template <class Found>
void each_loop(CapEdges& edges, std::size_t vertex_count, const Found& found) {
    std::vector<std::uint32_t> place(vertex_count, no_vertex);  // index on the walk
    std::vector<std::uint32_t> walk;
    for (std::uint32_t start = 0; start < vertex_count; ++start) {
        if (edges.left(start) == 0) continue;
        walk.assign(1, start);
        place[start] = 0;
        // Every vertex has as many edges in as out, so the walk can only end where it began.
        while (edges.left(walk.back()) > 0) {
            const std::uint32_t previous = walk.size() > 1 ? walk[walk.size() - 2] : no_vertex;
            const std::uint32_t next = edges.take(walk.back(), previous);
            if (place[next] == no_vertex) {
                place[next] = static_cast<std::uint32_t>(walk.size());
                walk.push_back(next);
                continue;
            }
            const std::size_t at = place[next];
            found(std::span<const std::uint32_t>(walk).subspan(at));
            for (std::size_t i = at + 1; i < walk.size(); ++i) place[walk[i]] = no_vertex;
            walk.resize(at + 1);
        }
        place[start] = no_vertex;
    }
}

}  // namespace

std::size_t cap_holes(TriangleMesh& mesh) {
    CapEdges open(mesh, MeshEdges(mesh.triangles, mesh.vertices.size()));
    if (open.empty()) return 0;
    const std::size_t before = mesh.triangles.size();
    std::vector<dvec3> points;
    Triangles cut;
    each_loop(open, mesh.vertices.size(), [&](std::span<const std::uint32_t> loop) {
        points.clear();
        cut.clear();
        for (const std::uint32_t v : loop) points.push_back(mesh.vertices[v]);
        triangulate_loop(points, cut);
        for (const auto& [a, b, c] : cut) mesh.triangles.push_back({loop[a], loop[b], loop[c]});
    });
    return mesh.triangles.size() - before;
}

Holes holes_under(const TriangleMesh& mesh, std::size_t caps) {
    const Triangles lids(mesh.triangles.end() - static_cast<std::ptrdiff_t>(caps), mesh.triangles.end());
    const MeshEdges edges(lids, mesh.vertices.size());
    std::size_t count = 0;
    const std::vector<std::uint32_t> hole = edges.bodies(count);
    std::vector<double> area(count, 0.0);
    std::vector<double> rim(count, 0.0);
    for (std::size_t t = 0; t < lids.size(); ++t) {
        const dvec3 a = mesh.vertices[lids[t][0]];
        const dvec3 cross = glm::cross(mesh.vertices[lids[t][1]] - a, mesh.vertices[lids[t][2]] - a);
        area[hole[t]] += 0.5 * std::sqrt(glm::dot(cross, cross));
    }
    for (const MeshEdges::Edge& e : edges.edges()) {
        if (e.count() == 1)
            rim[hole[edges.half_edges(e)[0] / 3]] += glm::distance(mesh.vertices[e.lo], mesh.vertices[e.hi]);
    }
    const dvec3 size = mesh.bounds().size();
    const double hairline = 1e-4 * std::sqrt(glm::dot(size, size));
    Holes holes;
    for (std::size_t h = 0; h < count; ++h)
        ++(area[h] <= 0.5 * rim[h] * hairline ? holes.hairlines : holes.wide);
    return holes;
}

}  // namespace lamella
