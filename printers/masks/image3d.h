// Back-end: a stack of layer images in a 3MF package (3MF volumetric extension 1.0).
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Makes a back-end that writes one package: a PNG sheet of grey coverage per layer, an image3d of the
/// sheets, a function that samples it, and a level set that is solid where more than half of a voxel is
/// covered. Supports have their own sheets and level set. A voxel measures ImageProfile::pixel_x by pixel_y
/// by the layer height; antialiasing and bits are those of the profile. The grid has the size of the job and
/// one more pixel on each side, so that nothing touches its border. Memory: about 1 kB per layer for the
/// names of its files. An interrupted run is resumed after the last layer.
///
/// Level sets use the part's own x and y and heights above the plate; the build item moves the grid's corner
/// to the origin. Programs interpolate between sheets, which rounds edges by about half a voxel.
std::unique_ptr<Backend> make_image3d(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
