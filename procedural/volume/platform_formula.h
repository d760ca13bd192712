// Building blocks of formulas about objects in a 3MF: transformed points, boxes, and fallbacks for undefined
// numbers.
#pragma once

#include <optional>
#include <span>

#include "engine/field/grading.h"
#include "engine/io/graph_nodes.h"
#include "engine/io/model_3mf.h"
#include "engine/mesh/mesh.h"

namespace lamella {

/// Returns the formula's inputs 0 to 2 as a point.
GraphValue platform(FormulaBuilder& f);
/// Returns the point under a map, written out in components; terms with a zero factor are omitted.
GraphValue mapped(FormulaBuilder& f, const GraphValue& place, const Transform3mf& map);
/// Returns the maximum of a value and the distance of a point outside a box.
FormulaBuilder::Node within_box(FormulaBuilder& f, FormulaBuilder::Node value, const GraphValue& place,
                                const Box& box);
/// Returns the value, or the fallback where the value is NaN.
FormulaBuilder::Node or_else(FormulaBuilder& f, FormulaBuilder::Node value, double fallback);
/// Returns whether the formula may be NaN within 1 km of the origin, as far as interval bounds can tell.
bool maybe_undefined(const Formula& formula, std::span<const GradingPtr> others);

/// Returns the map followed by a scaling.
Transform3mf scaled(Transform3mf map, double factor);
/// Returns whether the map sends axis-aligned boxes to axis-aligned boxes.
bool keeps_axes(const Transform3mf& map);
/// Returns the factor by which the map scales all lengths; nothing if it keeps no angles.
std::optional<double> scale_of(const Transform3mf& map);
/// Returns the bounding box of a box's image.
Box image_of(const Box& box, const Transform3mf& map);
/// Returns whether a closed mesh equals its bounding box.
bool is_box(const TriangleMesh& mesh, const Box& box);

}  // namespace lamella
