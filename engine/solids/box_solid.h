// Solids without the boxes of a plan, and solids that consist of such boxes.
#pragma once

#include <functional>
#include <memory>

#include "engine/field/field.h"
#include "engine/runs/run_boxes.h"

namespace lamella {

/// Returns the solid without the boxes of a plan. Runs are subtracted exactly; the value is that of the
/// difference if the solid's metric is exact or bound. Throws InputError when an argument is null.
FieldPtr make_without_boxes(FieldPtr solid, std::shared_ptr<const RunBoxes> boxes);

/// Returns the solid without boxes that are given by layer: `layer_of` returns the layer that holds a height
/// (mm), never a lower one for a greater height, and layer l lies at heights l to l + 1 of the boxes' grid.
/// Runs are subtracted exactly; of the value only the sign is meaningful. Throws InputError when an argument
/// is null.
FieldPtr make_without_layer_boxes(FieldPtr solid, std::shared_ptr<const RunBoxes> boxes,
                                  std::function<int(double z)> layer_of);

/// Returns the union of the boxes. Runs are exact. Outside, the value is the distance to the nearest box;
/// inside, its magnitude is at most the distance to the surface. Throws InputError when the argument is null.
FieldPtr make_box_solid(std::shared_ptr<const RunBoxes> boxes);

}  // namespace lamella
