// Sorts edges by face and chains them around each face.
#include "procedural/foam/cell_faces.h"

#include <algorithm>

namespace lamella {

std::size_t CellFaces::collect_edges(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
                                     Which which) {
    edges_.clear();
    const auto seed = [&](std::int32_t id) {
        return id < 0 ? nullptr : &sites[static_cast<std::size_t>(id)];
    };
    const auto add = [&](const Seed* face, const Seed* beyond, std::size_t from, std::size_t to) {
        if (!face) return;
        if (own.key < face->key) {
            edges_.push_back({face, beyond, from, to});
        } else if (which == Which::all) {
            edges_.push_back({face, beyond, to, from});
        }
    };
    cell.edges([&](std::int32_t a, std::int32_t b, std::size_t v, std::size_t w) {
        // Seen from outside, the ring of face b runs from v to w, that of face a from w to v.
        const Seed *first = seed(a), *second = seed(b);
        add(first, second, w, v);
        add(second, first, v, w);
    });
    std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) {
        if (a.face->key != b.face->key) return a.face->key < b.face->key;
        if (!a.beyond || !b.beyond) return a.beyond && !b.beyond;
        return a.beyond->key < b.beyond->key;
    });
    std::size_t left_out = 0;
    std::erase_if(edges_, [&](const Edge& edge) {
        const auto planes = cell.planes(edge.from);
        const bool unbounded =
            std::any_of(planes.begin(), planes.end(), [](std::int32_t p) { return p < 0; });
        left_out += unbounded;
        return unbounded;
    });
    return left_out;
}

/// Chains the vertices of a face into ring_. Returns false if its edges are not a closed ring.
bool CellFaces::order(std::span<const Edge> edges) {
    ring_.clear();
    std::size_t at = edges.front().from;
    for (std::size_t step = 0; step < edges.size(); ++step) {
        const auto next =
            std::find_if(edges.begin(), edges.end(), [&](const Edge& edge) { return edge.from == at; });
        if (next == edges.end()) return false;
        ring_.push_back(at);
        at = next->to;
    }
    return at == edges.front().from;
}

std::size_t CellFaces::list(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
                            const Stretch& stretch, Which which) {
    std::size_t left_out = collect_edges(cell, own, sites, which);
    nodes_.start(cell);
    faces_.clear();
    // All rings together are no longer than the edges, so the spans stay valid.
    corners_.clear();
    corners_.reserve(edges_.size());
    for (std::size_t first = 0, last = 0; first < edges_.size(); first = last) {
        while (last < edges_.size() && edges_[last].face == edges_[first].face) ++last;
        if (!order(std::span(edges_).subspan(first, last - first))) {
            ++left_out;
            continue;
        }
        const std::size_t begin = corners_.size();
        for (const std::size_t vertex : ring_) {
            corners_.push_back(stretch.to_part(nodes_.at(cell, vertex, own, sites)));
        }
        faces_.push_back({edges_[first].face->key, std::span(corners_).subspan(begin)});
    }
    return left_out;
}

}  // namespace lamella
