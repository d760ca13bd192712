// Voxelises a field: an element is solid if its centre is.
#pragma once

#include "engine/base/cancel_token.h"
#include "engine/field/field.h"
#include "procedural/elasticity/elastic_grid.h"

namespace lamella {

/// Divides a box into equal elements, `size` along its sides. An element is solid if its centre is inside the
/// field. Planes are sampled in parallel, on the threads of the calling task arena. Throws InputError for a
/// box without a volume or a side without elements, Interrupted once `cancel` (may be null) is set.
ElementMask sample_field(const Field& field, const Box& box, glm::ivec3 size,
                         const CancelToken* cancel = nullptr);

/// The same with cubic elements: `along_x` of them along x; along y and z as many as fit the box's sides,
/// rounded, at most 1024.
ElementMask sample_field(const Field& field, const Box& box, int along_x,
                         const CancelToken* cancel = nullptr);

}  // namespace lamella
