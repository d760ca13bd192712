// Elements of a solid: which cells of a grid have their middle in it.
#pragma once

#include "engine/field/field.h"
#include "procedural/elasticity/elastic_grid.h"

namespace lamella {

/// Cuts a box into cubic elements, `along_x` of them along x and as many along y and z as its sides say,
/// rounded. An element is present where its middle is solid. Planes are taken in parallel, on the calling
/// task arena's threads.
ElementMask sample_field(const Field& field, const Box& box, int along_x);

}  // namespace lamella
