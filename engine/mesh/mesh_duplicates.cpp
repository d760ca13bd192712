// Finds triangles on the same three corners by sorting.
#include "engine/mesh/mesh_duplicates.h"

#include <algorithm>
#include <span>
#include <tuple>

#include "engine/mesh/mesh_edges.h"

namespace lamella {

namespace {

/// A triangle by its corners in ascending order; `flipped` when that order reverses it.
struct Placed {
    std::array<std::uint32_t, 3> corners;
    bool flipped;
    std::uint32_t triangle;
    bool operator<(const Placed& other) const {
        return std::tie(corners, flipped, triangle) < std::tie(other.corners, other.flipped, other.triangle);
    }
};

std::vector<Placed> sorted_by_corners(const Triangles& triangles) {
    std::vector<Placed> placed;
    placed.reserve(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        auto [a, b, c] = triangles[t];
        bool flipped = false;
        const auto order = [&](std::uint32_t& x, std::uint32_t& y) {
            if (x < y) return;
            std::swap(x, y);
            flipped = !flipped;
        };
        order(a, b);
        order(b, c);
        order(a, b);
        placed.push_back({{a, b, c}, flipped, t});
    }
    std::sort(placed.begin(), placed.end());
    return placed;
}

/// Calls visit(same, opposite) for each set of three corners, with the triangles that face one way and the
/// other.
template <class Visit>
void each_place(const std::vector<Placed>& placed, const Visit& visit) {
    for (std::size_t begin = 0; begin < placed.size();) {
        std::size_t middle = begin;
        while (middle < placed.size() && placed[middle].corners == placed[begin].corners &&
               !placed[middle].flipped)
            ++middle;
        std::size_t end = middle;
        while (end < placed.size() && placed[end].corners == placed[begin].corners) ++end;
        const std::span all(placed);
        visit(all.subspan(begin, middle - begin), all.subspan(middle, end - middle));
        begin = end;
    }
}

Triangles without(const Triangles& triangles, const std::vector<bool>& gone) {
    Triangles kept;
    kept.reserve(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (!gone[t]) kept.push_back(triangles[t]);
    }
    return kept;
}

}  // namespace

DroppedDuplicates drop_duplicates(TriangleMesh& mesh, BackToBack back_to_back) {
    const std::vector<Placed> placed = sorted_by_corners(mesh.triangles);
    std::vector<bool> cancelled(mesh.triangles.size(), false);
    DroppedDuplicates dropped;
    each_place(placed, [&](auto one_side, auto other_side) {
        const std::size_t pairs = std::min(one_side.size(), other_side.size());
        if (pairs == 0) return;
        // Cancelling removes the latest copies, so that the remaining ones keep their places; keeping one
        // removes the other side entirely.
        for (std::size_t i = 0; i < pairs; ++i) {
            cancelled[other_side[other_side.size() - 1 - i].triangle] = true;
            if (back_to_back == BackToBack::cancel)
                cancelled[one_side[one_side.size() - 1 - i].triangle] = true;
        }
        dropped.cancelled += back_to_back == BackToBack::cancel ? 2 * pairs : pairs;
    });
    if (dropped.cancelled > 0) mesh.triangles = without(mesh.triangles, cancelled);

    const std::vector<Placed> remaining = dropped.cancelled > 0 ? sorted_by_corners(mesh.triangles) : placed;
    std::vector<bool> is_copy(mesh.triangles.size(), false);
    std::size_t copies = 0;
    const auto mark = [&](std::span<const Placed> side) {
        for (std::size_t i = 1; i < side.size(); ++i) is_copy[side[i].triangle] = true;
        copies += side.empty() ? 0 : side.size() - 1;
    };
    each_place(remaining, [&](auto one_side, auto other_side) {
        mark(one_side);
        mark(other_side);
    });
    if (copies == 0) return dropped;
    Triangles thinned = without(mesh.triangles, is_copy);
    const MeshEdges with_copies(mesh.triangles, mesh.vertices.size());
    const MeshEdges thinned_edges(thinned, mesh.vertices.size());
    if (thinned_edges.odd_edges() > with_copies.odd_edges()) return dropped;
    mesh.triangles = std::move(thinned);
    dropped.copies = copies;
    return dropped;
}

CancelledCaps cancel_caps(TriangleMesh& mesh, std::size_t caps) {
    const std::size_t first_cap = mesh.triangles.size() - caps;
    std::vector<bool> gone(mesh.triangles.size(), false);
    CancelledCaps cancelled;
    each_place(sorted_by_corners(mesh.triangles), [&](auto one_side, auto other_side) {
        // Triangles of one side are in mesh order, so caps come last.
        for (std::size_t i = 0; i < std::min(one_side.size(), other_side.size()); ++i) {
            const std::uint32_t a = one_side[one_side.size() - 1 - i].triangle;
            const std::uint32_t b = other_side[other_side.size() - 1 - i].triangle;
            if (std::max(a, b) < first_cap) break;
            gone[a] = gone[b] = true;
            const std::size_t lids = (a >= first_cap ? 1U : 0U) + (b >= first_cap ? 1U : 0U);
            cancelled.caps += lids;
            cancelled.others += 2 - lids;
        }
    });
    if (cancelled.caps > 0) mesh.triangles = without(mesh.triangles, gone);
    return cancelled;
}

void drop_unused_vertices(TriangleMesh& mesh) {
    std::vector<std::uint32_t> name(mesh.vertices.size(), 0);
    for (const auto& t : mesh.triangles) {
        for (const std::uint32_t v : t) name[v] = 1;
    }
    std::uint32_t kept = 0;
    for (std::size_t v = 0; v < name.size(); ++v) {
        if (name[v] == 0) continue;
        mesh.vertices[kept] = mesh.vertices[v];
        name[v] = kept++;
    }
    mesh.vertices.resize(kept);
    for (auto& t : mesh.triangles) {
        for (std::uint32_t& v : t) v = name[v];
    }
}

}  // namespace lamella
