// Solids without the boxes of a plan, and solids that consist of such boxes.
#pragma once

#include <memory>

#include "engine/field/field.h"
#include "engine/runs/run_boxes.h"

namespace lamella {

/// Returns the solid without the boxes of a plan. Runs are subtracted exactly; the value is that of the
/// difference if the solid's metric is exact or bound. Throws InputError when an argument is null.
FieldPtr make_without_boxes(FieldPtr solid, std::shared_ptr<const RunBoxes> boxes);

/// Returns the union of the boxes. Runs are exact. Outside, the value is the distance to the nearest box;
/// inside, its magnitude is at most the distance to the surface. Throws InputError when the argument is null.
FieldPtr make_box_solid(std::shared_ptr<const RunBoxes> boxes);

}  // namespace lamella
