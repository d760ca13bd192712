// A mesh with a graded number on its surface, divided until the number is linear over its triangles.
#pragma once

#include <vector>

#include "engine/field/grading.h"
#include "engine/mesh/mesh.h"

namespace lamella {

/// Triangles with a number at each vertex.
struct GradedMesh {
    TriangleMesh mesh;
    std::vector<double> numbers;  ///< one per vertex
};

/// Samples a grading of finite lengths >= 0 (mm) on a mesh. Triangles over which it is not linear to 2 % of
/// its largest value there are divided, together with their neighbours, so that a closed, oriented mesh stays
/// so. Division ends where a triangle's edges are shorter than a quarter of the length, after 10 halvings, or
/// at eight million new triangles. Linearity is tested on a lattice of points over the triangle, spaced by
/// the length or with 16 steps per edge. Deterministic.
GradedMesh read_on_mesh(const Grading& lengths, const TriangleMesh& mesh);

}  // namespace lamella
