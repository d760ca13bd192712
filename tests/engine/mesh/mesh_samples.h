// Small meshes written down by hand, and files made of them, for the tests of mesh reading and closing.
#pragma once

#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "engine/io/mesh_reader.h"
#include "engine/mesh/mesh.h"

namespace lamella::samples {

inline std::string model(const std::string& name) {
    return std::string(LAMELLA_SOURCE_DIR) + "/tests/models/" + name;
}

inline MeshFile from_memory(const std::string& name, const std::string& bytes, MeshReadOptions options = {}) {
    return read_mesh(name, std::as_bytes(std::span(bytes)), options);
}

/// The box from lo to hi, 12 triangles facing outwards.
inline TriangleMesh box_mesh(dvec3 lo, dvec3 hi) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.vertices.emplace_back((i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y,
                                   (i & 4) != 0 ? hi.z : lo.z);
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

inline TriangleMesh unit_box_at(double x) { return box_mesh(dvec3(x, 0.0, 0.0), dvec3(x + 1.0, 1.0, 1.0)); }

inline void append(TriangleMesh& mesh, const TriangleMesh& other, bool reversed = false) {
    const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (auto t : other.triangles) {
        if (reversed) std::swap(t[1], t[2]);
        mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    }
}

/// The walls of a prism over a polygon (counter-clockwise) from z = 0 to height, open above and below.
inline TriangleMesh tube(const std::vector<dvec2>& polygon, double height) {
    TriangleMesh mesh;
    const auto n = static_cast<std::uint32_t>(polygon.size());
    for (const dvec2& p : polygon) mesh.vertices.emplace_back(p.x, p.y, 0.0);
    for (const dvec2& p : polygon) mesh.vertices.emplace_back(p.x, p.y, height);
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        mesh.triangles.push_back({i, j, j + n});
        mesh.triangles.push_back({i, j + n, i + n});
    }
    return mesh;
}

/// An L of 88 mm2, 8 mm high.
inline TriangleMesh l_shape() {
    const std::vector<dvec2> outline{{0, 0}, {10, 0}, {10, 4}, {6, 4}, {6, 12}, {0, 12}};
    TriangleMesh mesh = tube(outline, 8);
    for (std::uint32_t i = 1; i + 1 < 6; ++i) {
        mesh.triangles.push_back({0, i + 1, i});
        mesh.triangles.push_back({6, 6 + i, 7 + i});
    }
    return mesh;
}
inline constexpr double l_volume = 704;  ///< mm3
inline constexpr double l_area = 528;    ///< mm2: twice 88, and a perimeter of 44 times 8

/// A star with 2 * points corners, the inner ones at `inner` of the outer radius 10.
inline std::vector<dvec2> star(int points, double inner) {
    std::vector<dvec2> corners;
    for (int i = 0; i < 2 * points; ++i) {
        const double r = i % 2 == 0 ? 10.0 : 10.0 * inner;
        const double angle = 3.14159265358979323846 * i / points;
        corners.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    return corners;
}

inline double polygon_area(const std::vector<dvec2>& p) {
    double twice = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const dvec2& q = p[(i + 1) % p.size()];
        twice += p[i].x * q.y - p[i].y * q.x;
    }
    return twice / 2.0;
}

inline double volume(const TriangleMesh& mesh) {
    double six = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        six += glm::dot(mesh.vertices[a], glm::cross(mesh.vertices[b], mesh.vertices[c]));
    }
    return six / 6.0;
}

/// Binary STL with any header.
inline std::string binary_stl(const TriangleMesh& mesh, const std::string& header = "") {
    std::string bytes = header;
    bytes.resize(80, ' ');
    const auto put = [&](const void* p, std::size_t n) { bytes.append(static_cast<const char*>(p), n); };
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    put(&count, 4);
    for (const auto& t : mesh.triangles) {
        bytes.append(12, '\0');
        for (const std::uint32_t v : t) {
            for (int axis = 0; axis < 3; ++axis) {
                const auto x = static_cast<float>(mesh.vertices[v][axis]);
                put(&x, 4);
            }
        }
        bytes.append(2, '\0');
    }
    return bytes;
}

}  // namespace lamella::samples
