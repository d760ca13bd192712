// Makes triangles agree within patches, then patches with each other; turns bodies outwards.
#include "engine/mesh/mesh_orient.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "engine/mesh/mesh_rays.h"

namespace lamella {

namespace {

constexpr std::uint32_t no_body = 0xffffffffU;

void turn(std::array<std::uint32_t, 3>& triangle) { std::swap(triangle[1], triangle[2]); }

/// Patches of triangles connected through edges with two triangles, and the triangles that disagree with
/// their patch.
struct Patches {
    std::vector<std::uint32_t> patch;  // of each triangle
    std::vector<bool> turned;          // of each triangle
    std::vector<std::uint32_t> size;   // of each patch
};

Patches patches_of(const Triangles& triangles, const MeshEdges& edges) {
    Patches out{std::vector<std::uint32_t>(triangles.size(), no_body),
                std::vector<bool>(triangles.size(), false),
                {}};
    std::vector<std::uint32_t> members;
    for (std::uint32_t seed = 0; seed < triangles.size(); ++seed) {
        if (out.patch[seed] != no_body) continue;
        const auto number = static_cast<std::uint32_t>(out.size.size());
        members.assign(1, seed);
        out.patch[seed] = number;
        std::size_t turned = 0;
        for (std::size_t i = 0; i < members.size(); ++i) {
            const std::uint32_t t = members[i];
            for (std::uint32_t half = 3 * t; half < 3 * t + 3; ++half) {
                const MeshEdges::Edge& edge = edges.edges()[edges.edge_of(half)];
                if (edge.count() != 2) continue;
                const auto halves = edges.half_edges(edge);
                const std::uint32_t other = (halves[0] == half ? halves[1] : halves[0]) / 3;
                if (out.patch[other] != no_body) continue;
                out.patch[other] = number;
                out.turned[other] = edge.is_matched_pair() ? out.turned[t] : !out.turned[t];
                turned += out.turned[other] ? 1 : 0;
                members.push_back(other);
            }
        }
        if (turned * 2 > members.size()) {
            for (const std::uint32_t t : members) out.turned[t] = !out.turned[t];
        }
        out.size.push_back(static_cast<std::uint32_t>(members.size()));
    }
    return out;
}

/// Contribution of a patch to the net count of an edge where three or more triangles meet.
struct Share {
    std::uint32_t patch, edge;
    std::int64_t amount;
};

std::vector<Share> shares_of(const Triangles& triangles, const MeshEdges& edges, const Patches& patches) {
    std::vector<Share> shares;
    for (std::uint32_t e = 0; e < edges.edges().size(); ++e) {
        const MeshEdges::Edge& edge = edges.edges()[e];
        if (edge.count() < 3) continue;
        for (const std::uint32_t half : edges.half_edges(edge)) {
            const bool forward = (from(triangles, half) == edge.lo) != patches.turned[half / 3];
            shares.push_back({patches.patch[half / 3], e, forward ? 1 : -1});
        }
    }
    const auto before = [](const Share& a, const Share& b) {
        return a.patch != b.patch ? a.patch < b.patch : a.edge < b.edge;
    };
    std::sort(shares.begin(), shares.end(), before);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        if (kept > 0 && !before(shares[kept - 1], shares[i])) {
            shares[kept - 1].amount += shares[i].amount;
        } else {
            shares[kept++] = shares[i];
        }
    }
    shares.resize(kept);
    return shares;
}

/// Returns the patches to flip: small ones first, as long as this reduces the net boundary.
std::vector<bool> patches_to_turn(const Triangles& triangles, const MeshEdges& edges,
                                  const Patches& patches) {
    constexpr int max_rounds = 16;
    std::vector<bool> turned(patches.size.size(), false);
    std::vector<Share> shares = shares_of(triangles, edges, patches);
    std::vector<std::int64_t> net(edges.edges().size(), 0);
    for (const Share& share : shares) net[share.edge] += share.amount;
    if (std::all_of(net.begin(), net.end(), [](std::int64_t n) { return n == 0; })) return turned;

    std::vector<std::size_t> begins;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        if (i == 0 || shares[i].patch != shares[i - 1].patch) begins.push_back(i);
    }
    const auto size_at = [&](std::size_t begin) { return patches.size[shares[begin].patch]; };
    std::stable_sort(begins.begin(), begins.end(),
                     [&](std::size_t a, std::size_t b) { return size_at(a) < size_at(b); });
    bool changed = true;
    for (int round = 0; changed && round < max_rounds; ++round) {
        changed = false;
        for (const std::size_t begin : begins) {
            const std::uint32_t patch = shares[begin].patch;
            std::int64_t gain = 0;
            std::size_t end = begin;
            for (; end < shares.size() && shares[end].patch == patch; ++end) {
                const std::int64_t n = net[shares[end].edge];
                gain += std::abs(n) - std::abs(n - 2 * shares[end].amount);
            }
            if (gain <= 0) continue;
            for (std::size_t i = begin; i < end; ++i) {
                net[shares[i].edge] -= 2 * shares[i].amount;
                shares[i].amount = -shares[i].amount;
            }
            turned[patch] = !turned[patch];
            changed = true;
        }
    }
    return turned;
}

}  // namespace

std::size_t agree_on_sides(TriangleMesh& mesh) {
    const MeshEdges edges(mesh.triangles, mesh.vertices.size());
    const Patches patches = patches_of(mesh.triangles, edges);
    const std::vector<bool> whole = patches_to_turn(mesh.triangles, edges, patches);
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (patches.turned[t] == whole[patches.patch[t]]) continue;
        turn(mesh.triangles[t]);
        ++count;
    }
    return count;
}

BodyVolumes body_volumes(const TriangleMesh& mesh, const MeshEdges& edges) {
    BodyVolumes out;
    std::size_t count = 0;
    out.body = edges.bodies(count);
    out.volume.assign(count, 0.0);
    out.area.assign(count, 0.0);
    // Volumes are computed relative to a corner of each body: with a distant origin the sum would lose its
    // digits.
    std::vector<std::uint32_t> origin(count, no_body);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        std::uint32_t& o = origin[out.body[t]];
        if (o == no_body) o = a;
        const dvec3 p = mesh.vertices[a] - mesh.vertices[o];
        const dvec3 q = mesh.vertices[b] - mesh.vertices[o];
        const dvec3 r = mesh.vertices[c] - mesh.vertices[o];
        const dvec3 normal = glm::cross(q - p, r - p);
        out.volume[out.body[t]] += glm::dot(p, glm::cross(q, r)) / 6.0;
        out.area[out.body[t]] += 0.5 * std::sqrt(glm::dot(normal, normal));
    }
    return out;
}

namespace {

/// Returns a point just inside each body, beneath its largest triangle.
std::vector<dvec3> inner_points(const TriangleMesh& mesh, const BodyVolumes& bodies) {
    std::vector<dvec3> points(bodies.volume.size(), dvec3(0.0));
    std::vector<double> largest(bodies.volume.size(), -1.0);
    const dvec3 size = mesh.bounds().size();
    const double depth = 1e-6 * std::sqrt(glm::dot(size, size));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const std::uint32_t body = bodies.body[t];
        const dvec3 normal =
            glm::cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
        const double twice_area = std::sqrt(glm::dot(normal, normal));
        if (!(twice_area > largest[body])) continue;
        largest[body] = twice_area;
        points[body] = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0;
        const double inwards = bodies.volume[body] < 0.0 ? depth : -depth;
        if (twice_area > 0.0) points[body] += normal * (inwards / twice_area);
    }
    return points;
}

}  // namespace

std::size_t turn_bodies_outwards(TriangleMesh& mesh, BodyVolumes& bodies) {
    std::vector<double>& volume = bodies.volume;
    if (std::all_of(volume.begin(), volume.end(), [](double v) { return v >= 0.0; })) return 0;
    std::vector<bool> turned(volume.size(), false);
    if (volume.size() == 1) {
        turned[0] = true;
    } else {
        // A body that contains another one encloses a greater volume, so it was decided earlier.
        std::vector<std::uint32_t> order(volume.size());
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::abs(volume[a]) > std::abs(volume[b]);
        });
        const std::vector<dvec3> points = inner_points(mesh, bodies);
        const MeshRays rays(mesh);
        std::vector<int> winding(volume.size(), 0);
        std::vector<std::uint32_t> hit;
        for (const std::uint32_t body : order) {
            hit.clear();
            rays.each_above(points[body], [&](std::uint32_t triangle, int sign) {
                hit.push_back(bodies.body[triangle]);
                winding[hit.back()] += sign;
            });
            std::sort(hit.begin(), hit.end());
            hit.erase(std::unique(hit.begin(), hit.end()), hit.end());
            std::uint32_t outermost = body;
            int around = 0;
            for (const std::uint32_t other : hit) {
                const int w = winding[other];
                winding[other] = 0;
                if (other == body || w == 0 || std::abs(volume[other]) <= std::abs(volume[body])) continue;
                around += turned[other] ? -w : w;
                if (std::abs(volume[other]) > std::abs(volume[outermost])) outermost = other;
            }
            turned[body] = outermost != body && turned[outermost];
            const bool inward = (volume[body] < 0.0) != turned[body];
            if (inward && around <= 0) turned[body] = !turned[body];
        }
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (turned[bodies.body[t]]) turn(mesh.triangles[t]);
    }
    for (std::size_t b = 0; b < volume.size(); ++b) volume[b] = turned[b] ? -volume[b] : volume[b];
    return static_cast<std::size_t>(std::count(turned.begin(), turned.end(), true));
}

}  // namespace lamella
