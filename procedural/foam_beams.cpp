// Owned edges of a cell, and the canonical position of nodes.
#include "procedural/foam_beams.h"

#include <algorithm>

namespace lamella {
namespace {

dvec3 cross(dvec3 a, dvec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double dot(dvec3 a, dvec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

}  // namespace

std::optional<dvec3> circumcenter(const std::array<dvec3, 4>& seeds) {
    // Volume over the product of the edges: below this, rounding alone moves the centre by about 1e-6 of them.
    constexpr double flat_squared = 1e-20;
    const dvec3 u = seeds[1] - seeds[0], v = seeds[2] - seeds[0], w = seeds[3] - seeds[0];
    const double uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
    const dvec3 vw = cross(v, w);
    const double volume = dot(u, vw);
    if (!(volume * volume > flat_squared * uu * vv * ww)) return std::nullopt;
    const dvec3 sum = uu * vw + vv * cross(w, u) + ww * cross(u, v);
    return seeds[0] + sum / (2 * volume);
}

dvec3 BeamMaker::node(const VoronoiCell& cell, std::size_t vertex, const Seed& own,
                      std::span<const Seed> sites) {
    if (known_[vertex]) return nodes_[vertex];
    std::array<const Seed*, 4> four = {&own, nullptr, nullptr, nullptr};
    const auto planes = cell.planes(vertex);
    for (std::size_t i = 0; i < 3; ++i) four[i + 1] = &sites[static_cast<std::size_t>(planes[i])];
    std::sort(four.begin(), four.end(), [](const Seed* a, const Seed* b) { return a->key < b->key; });
    const auto center = circumcenter({four[0]->position, four[1]->position, four[2]->position, four[3]->position});
    nodes_[vertex] = center ? *center : own.position + cell.vertex(vertex);
    known_[vertex] = true;
    return nodes_[vertex];
}

std::size_t BeamMaker::append(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
                              const NodeRadius& radius, std::vector<Beam>& beams) {
    edges_.clear();
    known_.assign(cell.vertex_count(), false);
    nodes_.resize(cell.vertex_count());
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
        // Seen from the cell, planes a and b meet counter-clockwise about v; the order of keys decides which
        // end comes first.
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
        const dvec3 from = node(cell, edge.from, own, sites), to = node(cell, edge.to, own, sites);
        beams.push_back({from, radius.at(from), to, radius.at(to)});
    }
    return left_out;
}

}  // namespace lamella
