// The edges that a cell owns, and the canonical positions of nodes.
#include "procedural/foam/foam_beams.h"

#include <algorithm>
#include <cmath>

#include "procedural/voronoi/double_double.h"

namespace lamella {
namespace {

dvec3 cross(dvec3 a, dvec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// If seeds tie to within the cell's tolerance, their computed circumcentre may be anywhere on the common
// edges.
constexpr double tie_width = 1e-6;
constexpr double double_is_enough = 1e-12;  // squared: about seven digits are lost, nine are left
constexpr double flat = 1e-36;  // squared: below this, the rounding of the seeds themselves dominates

using Precise = std::array<DoubleDouble, 3>;

DoubleDouble dot(const Precise& a, const Precise& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Precise cross(const Precise& a, const Precise& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Returns the circumcentre of nearly coplanar seeds, in twice the precision; empty if they are coplanar.
std::optional<dvec3> precise_circumcenter(dvec3 origin, dvec3 u, dvec3 v, dvec3 w) {
    const auto precise = [](dvec3 p) { return Precise{{{p.x}, {p.y}, {p.z}}}; };
    const Precise a = precise(u), b = precise(v), c = precise(w);
    const Precise bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const DoubleDouble aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
    const double volume = dot(a, bc).hi;
    if (!(volume * volume > flat * aa.hi * bb.hi * cc.hi)) return std::nullopt;
    dvec3 center;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        center[axis] = origin[axis] + (aa * bc[i] + bb * ca[i] + cc * ab[i]).hi / (2 * volume);
    }
    return center;
}

}  // namespace

std::optional<dvec3> circumcenter(const std::array<dvec3, 4>& seeds) {
    const dvec3 u = seeds[1] - seeds[0], v = seeds[2] - seeds[0], w = seeds[3] - seeds[0];
    const double uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
    const dvec3 vw = cross(v, w);
    const double volume = dot(u, vw), square = volume * volume, scale = uu * vv * ww;
    // The relative error of the centre grows with the product of the edge lengths over the volume.
    if (square > double_is_enough * scale) {
        return seeds[0] + (uu * vw + vv * cross(w, u) + ww * cross(u, v)) / (2 * volume);
    }
    return precise_circumcenter(seeds[0], u, v, w);
}

void CellNodes::start(const VoronoiCell& cell) {
    known_.assign(cell.vertex_count(), false);
    nodes_.resize(cell.vertex_count());
}

dvec3 CellNodes::at(const VoronoiCell& cell, std::size_t vertex, const Seed& own,
                    std::span<const Seed> sites) {
    if (known_[vertex]) return nodes_[vertex];
    std::array<const Seed*, 4> four = {&own, nullptr, nullptr, nullptr};
    const auto planes = cell.planes(vertex);
    for (std::size_t i = 0; i < 3; ++i) four[i + 1] = &sites[static_cast<std::size_t>(planes[i])];
    std::sort(four.begin(), four.end(), [](const Seed* a, const Seed* b) { return a->key < b->key; });
    const auto center =
        circumcenter({four[0]->position, four[1]->position, four[2]->position, four[3]->position});
    nodes_[vertex] = own.position + cell.vertex(vertex);
    if (center) {
        const dvec3 gap = glm::abs(*center - nodes_[vertex]);
        if (std::max({gap.x, gap.y, gap.z}) <= tie_width * std::sqrt(cell.reach_squared()))
            nodes_[vertex] = *center;
    }
    known_[vertex] = true;
    return nodes_[vertex];
}

std::size_t BeamMaker::append(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
                              std::vector<Beam>& beams) {
    edges_.clear();
    nodes_.start(cell);
    std::size_t left_out = 0;
    const auto bounded = [&](std::size_t v) {
        const auto planes = cell.planes(v);
        return planes[0] >= 0 && planes[1] >= 0 && planes[2] >= 0;
    };
    cell.edges([&](std::int32_t a, std::int32_t b, std::size_t v, std::size_t w) {
        if (a >= 0 && sites[static_cast<std::size_t>(a)].key < own.key) return;
        if (b >= 0 && sites[static_cast<std::size_t>(b)].key < own.key) return;
        if (!bounded(v) || !bounded(w)) {
            ++left_out;
            return;
        }
        const Seed* second = &sites[static_cast<std::size_t>(a)];
        const Seed* third = &sites[static_cast<std::size_t>(b)];
        // Seen from the cell, planes a and b meet counter-clockwise around v. The key order decides which end
        // comes first.
        if (third->key < second->key) {
            std::swap(second, third);
            std::swap(v, w);
        }
        edges_.push_back({second, third, v, w});
    });
    std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) {
        if (a.second->key != b.second->key) return a.second->key < b.second->key;
        return a.third->key < b.third->key;
    });
    for (const Edge& edge : edges_) {
        const dvec3 from = nodes_.at(cell, edge.from, own, sites), to = nodes_.at(cell, edge.to, own, sites);
        tapered_.add(stretch_.to_part(from), stretch_.to_part(to));
    }
    tapered_.append(beams);
    return left_out;
}

}  // namespace lamella
