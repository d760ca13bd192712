// A voxel volume as a number that varies in space.
#pragma once

#include <optional>
#include <string>

#include "engine/field/grading.h"
#include "procedural/volume/volume.h"

namespace lamella {

/// Where a volume comes from and where it lies.
struct VolumeSource {
    std::string path;             ///< see read_volume
    std::optional<Box> box = {};  ///< mm; what the file says when not given
    int channel = 0;              ///< of an image, from 0
};

/// The number at a point, trilinear between the centres of the voxels that fill the box, and constant beyond
/// the outermost centres. Integer images give 0 to 1; everything else the numbers of the file. The range is
/// exact for boxes over a few voxels, and found from a pyramid of block extremes for larger ones.
/// Throws InputError with the path; a volume whose file does not say where it lies needs a box.
GradingPtr make_volume_grading(const VolumeSource& source);

/// The same for a volume at hand. The box must have three positive, finite sides.
GradingPtr make_volume_grading(Volume volume, const Box& box);

}  // namespace lamella
