// A mesh on whose surface a graded number is known: divided until the number is linear over its triangles.
#pragma once

#include <vector>

#include "engine/field/grading.h"
#include "engine/mesh/mesh.h"

namespace lamella {

/// Triangles with a number at each vertex.
struct GradedMesh {
    TriangleMesh mesh;
    std::vector<double> numbers;  ///< one a vertex
};

/// Reads a grading of finite lengths >= 0 (mm) on a mesh. Triangles over which it is not linear to 2 % of its
/// largest number there are divided, neighbours alike, so that what was closed and oriented stays so.
/// Division ends where a triangle's edges are shorter than a quarter of the length, after 10 halvings, or at
/// eight million new triangles. Linearity is judged on a lattice of points over the triangle, as far apart as
/// the length or 16 to an edge. Deterministic.
GradedMesh read_on_mesh(const Grading& lengths, const TriangleMesh& mesh);

}  // namespace lamella
