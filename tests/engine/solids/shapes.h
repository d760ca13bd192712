// Meshes with known geometry for tests.
#pragma once

#include <cmath>
#include <map>

#include "engine/mesh/mesh_repair.h"

namespace lamella::shapes {

/// A mesh that is closed by construction, as close_mesh would return it.
inline SolidMesh closed(TriangleMesh mesh) {
    SolidMesh solid;
    solid.mesh = std::move(mesh);
    solid.oriented_manifold = true;
    return solid;
}

inline TriangleMesh box(dvec3 lo, dvec3 hi) {
    TriangleMesh mesh;
    for (int k = 0; k < 8; ++k) {
        mesh.vertices.push_back(
            {(k & 1) != 0 ? hi.x : lo.x, (k & 2) != 0 ? hi.y : lo.y, (k & 4) != 0 ? hi.z : lo.z});
    }
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

/// A sphere of triangles whose corners lie on the sphere.
inline TriangleMesh icosphere(int levels, double radius) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    TriangleMesh mesh;
    mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                     {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto key = std::minmax(a, b);
            const auto [found, added] =
                middles.try_emplace(key, static_cast<std::uint32_t>(mesh.vertices.size()));
            if (added) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]) * 0.5);
            return found->second;
        };
        auto triangles = std::move(mesh.triangles);
        mesh.triangles.clear();
        for (const auto& t : triangles) {
            const std::uint32_t ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
            mesh.triangles.push_back({t[0], ab, ca});
            mesh.triangles.push_back({t[1], bc, ab});
            mesh.triangles.push_back({t[2], ca, bc});
            mesh.triangles.push_back({ab, bc, ca});
        }
    }
    for (dvec3& v : mesh.vertices) v *= radius / glm::length(v);
    return mesh;
}

/// A prism over an L, 2 mm high: one reflex edge.
inline TriangleMesh l_prism() {
    const dvec2 outline[6] = {{-2, -2}, {2, -2}, {2, 0}, {0, 0}, {0, 2}, {-2, 2}};
    TriangleMesh mesh;
    for (const double z : {-1.0, 1.0}) {
        for (const dvec2 p : outline) mesh.vertices.push_back({p, z});
    }
    for (std::uint32_t k = 0; k < 6; ++k) {
        const std::uint32_t n = (k + 1) % 6;
        mesh.triangles.push_back({k, n, n + 6});
        mesh.triangles.push_back({k, n + 6, k + 6});
    }
    const std::array<std::uint32_t, 3> faces[4] = {{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}};
    for (const auto& f : faces) {
        mesh.triangles.push_back({f[0] + 6, f[1] + 6, f[2] + 6});
        mesh.triangles.push_back({f[2], f[1], f[0]});
    }
    return mesh;
}

}  // namespace lamella::shapes
