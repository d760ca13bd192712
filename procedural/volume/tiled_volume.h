// A voxel volume that is sampled in its own unit cube, and repeated, mirrored or held beyond it.
#pragma once

#include <array>

#include "engine/field/grading.h"
#include "engine/io/implicit_graph.h"
#include "procedural/volume/volume.h"

namespace lamella {

/// The number at (u, v, w), as 3MF samples an image3d: voxels fill the cube from 0 to 1, the first ones at 0.
/// `linear` is trilinear between the voxels' centres, over the border into the next tile; `nearest` takes the
/// voxel that holds the point, of two at the same distance the lower one along u and w and the upper one
/// along v, where the picture's rows run downwards. Coordinates outside the cube are wrapped, mirrored or
/// clamped; the style `none` clamps. Ranges enclose the voxels that a box can touch.
GradingPtr make_tiled_volume(Volume volume, ImageFilter filter, const std::array<TileStyle, 3>& tiles);

}  // namespace lamella
