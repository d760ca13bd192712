// Solids less the boxes of a plan, and solids that are such boxes.
#pragma once

#include <memory>

#include "engine/field/field.h"
#include "engine/runs/run_boxes.h"

namespace lamella {

/// The solid less the boxes of a plan. Runs are merged exactly; the value is that of the difference where the
/// solid's metric is exact or bound. Null arguments are an InputError.
FieldPtr make_without_boxes(FieldPtr solid, std::shared_ptr<const RunBoxes> boxes);

/// The boxes themselves. Runs are exact; outside, the value is the distance to the nearest box, inside at
/// most that to the surface. Null is an InputError.
FieldPtr make_box_solid(std::shared_ptr<const RunBoxes> boxes);

}  // namespace lamella
