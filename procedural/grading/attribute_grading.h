// A number at the vertices of a mesh, spread through space from its surface.
#pragma once

#include <string>

#include "engine/field/grading.h"
#include "engine/io/mesh_attribute.h"

namespace lamella {

/// The number at a point is `scale` times the attribute at the closest point of the surface, interpolated
/// over its triangle; of equally close triangles the first of the file. NaN where a corner's value is NaN.
/// Throws InputError as read_ply_attribute does.
GradingPtr make_attribute_grading(const std::string& path, const std::string& attribute, double unit_mm,
                                  double scale);

/// The same for a mesh at hand, with at least one triangle and a value a vertex.
GradingPtr make_attribute_grading(AttributedMesh surface, double scale = 1.0);

}  // namespace lamella
