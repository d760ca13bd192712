// Voxelises a field: an element is solid if its centre is.
#pragma once

#include "engine/base/cancel_token.h"
#include "engine/field/field.h"
#include "procedural/elasticity/elastic_grid.h"

namespace lamella {

/// Divides a box into cubic elements: `along_x` of them along x; along y and z as many as fit its sides,
/// rounded. An element is solid if its centre is inside the field. Planes are sampled in parallel, on the
/// threads of the calling task arena. Throws Interrupted once `cancel` (may be null) is set.
ElementMask sample_field(const Field& field, const Box& box, int along_x,
                         const CancelToken* cancel = nullptr);

}  // namespace lamella
