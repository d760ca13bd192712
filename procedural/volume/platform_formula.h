// Parts of formulas about objects of a 3MF: places under transforms, boxes, and what to do where a number is
// undefined.
#pragma once

#include <span>

#include "engine/field/grading.h"
#include "engine/io/graph_nodes.h"
#include "engine/io/model_3mf.h"
#include "engine/mesh/mesh.h"

namespace lamella {

/// The formula's inputs 0 to 2 as a place.
GraphValue platform(FormulaBuilder& f);
/// The place under a map, taken apart; what is multiplied by zero is left out.
GraphValue mapped(FormulaBuilder& f, const GraphValue& place, const Transform3mf& map);
/// The greater of a value and how far a place lies outside a box.
FormulaBuilder::Node within_box(FormulaBuilder& f, FormulaBuilder::Node value, const GraphValue& place,
                                const Box& box);
/// The value, or the fallback where it is NaN.
FormulaBuilder::Node or_else(FormulaBuilder& f, FormulaBuilder::Node value, double fallback);
/// Whether the formula may be NaN within 1 km of the origin, as far as ranges can tell.
bool maybe_undefined(const Formula& formula, std::span<const GradingPtr> others);

/// The map, then a scaling.
Transform3mf scaled(Transform3mf map, double factor);
/// Whether boxes stay boxes under the map.
bool keeps_axes(const Transform3mf& map);
/// The box about a box's image.
Box image_of(const Box& box, const Transform3mf& map);
/// Whether a closed mesh is nothing but the box about it.
bool is_box(const TriangleMesh& mesh, const Box& box);

}  // namespace lamella
