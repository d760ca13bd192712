// A grading from numbers at the vertices of a mesh: the value at the closest point of its surface.
#pragma once

#include <string>

#include "engine/field/grading.h"
#include "engine/io/mesh_attribute.h"

namespace lamella {

/// Makes the grading `scale` times the attribute at the closest point of the surface, interpolated over its
/// triangle. Among equally close triangles the first in the file counts. NaN where the value at a corner of
/// the triangle is NaN. Throws InputError as read_ply_attribute does.
GradingPtr make_attribute_grading(const std::string& path, const std::string& attribute, double unit_mm,
                                  double scale);

/// Makes the grading for a given mesh, with at least one triangle and one value per vertex.
GradingPtr make_attribute_grading(AttributedMesh surface, double scale = 1.0);

}  // namespace lamella
