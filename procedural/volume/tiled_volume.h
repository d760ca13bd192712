// A voxel volume sampled in its unit cube, and repeated, mirrored or clamped beyond it.
#pragma once

#include <array>

#include "engine/field/grading.h"
#include "engine/io/implicit_graph.h"
#include "procedural/volume/volume.h"

namespace lamella {

/// Makes the grading over (u, v, w) that 3MF defines for an image3d: voxels fill the cube from 0 to 1, the
/// first ones at 0. `linear` is trilinear between the voxels' centres, also across the border into the next
/// tile. `nearest` takes the voxel that contains the point; between two voxels it takes the lower one along u
/// and w, and the upper one along v, because the picture's rows run downwards. Coordinates outside the cube
/// are wrapped, mirrored or clamped; the style `none` clamps. Ranges include all voxels that a box can touch.
GradingPtr make_tiled_volume(Volume volume, ImageFilter filter, const std::array<TileStyle, 3>& tiles);

}  // namespace lamella
