// TriangleMesh: a triangle mesh as plain data.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Greater coordinates count as damage, mm (1,000 km; also keeps squares and cubes finite).
inline constexpr double max_coordinate = 1e9;

/// Triangles over shared vertices, counter-clockwise seen from outside; mm.
struct TriangleMesh {
    std::vector<dvec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    Box bounds() const {
        Box box;
        for (const auto& triangle : triangles) {
            for (const std::uint32_t corner : triangle) box.include(vertices[corner]);
        }
        return box;
    }
};

}  // namespace lamella
