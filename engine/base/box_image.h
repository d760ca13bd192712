// Bounding boxes of mapped boxes.
#pragma once

#include "engine/base/geometry.h"

namespace lamella {

/// Returns the bounding box of a box's image under p -> linear p + translation; empty boxes stay empty.
Box image_of(const Box& box, const glm::dmat3& linear, dvec3 translation = dvec3(0));

}  // namespace lamella
