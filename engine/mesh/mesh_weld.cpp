// Border welding: a grid over the border vertices, and a union of vertices within reach of each other.
#include "engine/mesh/mesh_weld.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "engine/mesh/mesh_edges.h"

namespace lamella {

namespace {

/// The border vertices, sorted by their cell of a cubic grid.
class VertexGrid {
  public:
    VertexGrid(const TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices, double cell)
        : origin_(mesh.bounds().lo), cell_(cell) {
        for (const std::uint32_t v : vertices) entries_.push_back({key(cell_of(mesh.vertices[v])), v});
        std::sort(entries_.begin(), entries_.end());
    }

    /// Calls visit(v) for the vertices in the 27 cells around p; limits their number for each row of three
    /// cells.
    template <class Visit>
    void around(dvec3 p, const Visit& visit) const {
        constexpr int max_per_row = 128;
        const std::array<std::int64_t, 3> c = cell_of(p);
        for (int n = 0; n < 9; ++n) {
            const std::uint64_t first = key({c[0] + n % 3 - 1, c[1] + n / 3 - 1, c[2] - 1});
            auto entry = std::lower_bound(entries_.begin(), entries_.end(), Entry{first, 0});
            for (int i = 0; i < max_per_row && entry != entries_.end() && entry->key <= first + 2; ++i) {
                visit((entry++)->vertex);
            }
        }
    }

  private:
    struct Entry {
        std::uint64_t key;
        std::uint32_t vertex;
        bool operator<(const Entry& other) const {
            return key != other.key ? key < other.key : vertex < other.vertex;
        }
    };

    std::array<std::int64_t, 3> cell_of(dvec3 p) const {
        const dvec3 q = (p - origin_) / cell_;
        return {static_cast<std::int64_t>(q.x), static_cast<std::int64_t>(q.y),
                static_cast<std::int64_t>(q.z)};
    }
    /// A million cells per axis fit 21 bits each; the smallest tolerance is a millionth of the diagonal.
    static std::uint64_t key(const std::array<std::int64_t, 3>& c) {
        const auto part = [](std::int64_t i) { return static_cast<std::uint64_t>(i + 1) & 0x1fffffU; };
        return part(c[0]) << 42U | part(c[1]) << 21U | part(c[2]);
    }

    dvec3 origin_;
    double cell_;
    std::vector<Entry> entries_;
};

struct Border {
    std::vector<std::uint32_t> vertices;
    std::vector<double> shortest_edge;  // by mesh vertex; only border vertices have a finite one
};

Border border_of(const TriangleMesh& mesh, const MeshEdges& edges) {
    Border border;
    std::vector<bool> is_border(mesh.vertices.size(), false);
    for (const MeshEdges::Edge& e : edges.edges()) {
        if (e.count() % 2 == 0) continue;
        for (const std::uint32_t v : {e.lo, e.hi}) {
            if (!is_border[v]) border.vertices.push_back(v);
            is_border[v] = true;
        }
    }
    border.shortest_edge.assign(mesh.vertices.size(), infinity);
    for (const MeshEdges::Edge& e : edges.edges()) {
        if (!is_border[e.lo] && !is_border[e.hi]) continue;
        const double size = length(mesh.vertices[e.hi] - mesh.vertices[e.lo]);
        for (const std::uint32_t v : {e.lo, e.hi}) {
            border.shortest_edge[v] = std::min(border.shortest_edge[v], size);
        }
    }
    std::sort(border.vertices.begin(), border.vertices.end());
    return border;
}

/// Returns the new vertex of each vertex after joining border vertices closer than `tolerance`.
std::vector<std::uint32_t> joined(const TriangleMesh& mesh, const Border& border, double tolerance,
                                  bool keep_detail, BorderWeld& weld) {
    std::vector<std::uint32_t> root(mesh.vertices.size());
    std::iota(root.begin(), root.end(), 0U);
    const auto find = [&](std::uint32_t v) {
        for (; root[v] != v; v = root[v]) root[v] = root[root[v]];
        return v;
    };
    const auto reach = [&](std::uint32_t v) {
        return keep_detail ? std::min(tolerance, 0.1 * border.shortest_edge[v]) : tolerance;
    };
    const VertexGrid grid(mesh, border.vertices, tolerance);
    for (const std::uint32_t v : border.vertices) {
        grid.around(mesh.vertices[v], [&](std::uint32_t other) {
            const std::uint32_t a = find(v);
            const std::uint32_t b = find(other);
            // Distances are measured between the surviving vertices, so that a row of close vertices cannot
            // collapse into one.
            const double apart = length(mesh.vertices[b] - mesh.vertices[a]);
            if (a == b || apart > std::min(reach(v), reach(other))) return;
            root[std::max(a, b)] = std::min(a, b);
            ++weld.joined;
            weld.farthest = std::max(weld.farthest, apart);
        });
    }
    for (std::uint32_t v = 0; v < root.size(); ++v) root[v] = find(v);
    return root;
}

Triangles renamed(const Triangles& triangles, const std::vector<std::uint32_t>& name) {
    Triangles out;
    out.reserve(triangles.size());
    for (const auto& [a, b, c] : triangles) {
        const std::array<std::uint32_t, 3> t{name[a], name[b], name[c]};
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) out.push_back(t);
    }
    return out;
}

}  // namespace

BorderWeld weld_borders(TriangleMesh& mesh) {
    BorderWeld total;
    const double diagonal = length(mesh.bounds().size());
    MeshEdges edges(mesh.triangles, mesh.vertices.size());
    for (const double relative : {1e-6, 1e-5, 1e-4}) {
        const std::size_t open = edges.odd_edges();
        if (open == 0 || !(diagonal > 0.0)) break;
        BorderWeld step;
        const Border border = border_of(mesh, edges);
        Triangles candidate =
            renamed(mesh.triangles, joined(mesh, border, relative * diagonal, relative > 1e-6, step));
        if (step.joined == 0) continue;
        MeshEdges candidate_edges(candidate, mesh.vertices.size());
        if (candidate_edges.odd_edges() >= open) continue;
        mesh.triangles = std::move(candidate);
        edges = std::move(candidate_edges);
        total.joined += step.joined;
        total.farthest = std::max(total.farthest, step.farthest);
    }
    return total;
}

}  // namespace lamella
