// Back-end: layers as an image stack in a 3MF package (3MF volumetric extension 1.0).
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Writes one package: a PNG sheet of grey coverage a layer, an image3d of them, a function that samples it,
/// and a level set that is solid where more than half of a voxel is covered. Supports have sheets and a level
/// set of their own. Voxels are ImageProfile::pixel_x, pixel_y and a layer's height large, with antialiasing
/// and bits as there; the grid is as large as the job and a pixel more at each side, so that nothing lies at
/// its border. Of layers there is kept in memory what their names take, about 1 kB each, and a run that
/// was stopped is continued behind the last one.
///
/// Level sets have the part's own x and y and heights over the plate; the build item moves the grid's corner
/// to the origin. Programs interpolate between sheets, which rounds edges by about half a voxel.
std::unique_ptr<Backend> make_image3d(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
