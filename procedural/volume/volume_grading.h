// A grading from a voxel volume.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "engine/field/grading.h"
#include "procedural/volume/density_bricks.h"
#include "procedural/volume/volume.h"

namespace lamella {

/// The file of a volume, and its position.
struct VolumeSource {
    std::string path;             ///< see read_volume
    std::optional<Box> box = {};  ///< mm; that of the file if not given
    int channel = 0;              ///< of an image, from 0
};

/// Makes a grading from a volume: trilinear between the centres of the voxels that fill the box, constant
/// beyond the outermost centres. Integer images give 0 to 1, other files their own numbers. Ranges are exact
/// for boxes over a few voxels; for larger ones they are bounds from a pyramid of block extremes. Throws
/// InputError with the path. If the file does not give a position, `source.box` is required.
GradingPtr make_volume_grading(const VolumeSource& source);

/// Makes the grading for a given volume. The box must have three positive, finite sides.
GradingPtr make_volume_grading(Volume volume, const Box& box);

/// Makes the grading of bricks: the same numbers and ranges, to the last bit, as that of the volume with all
/// their samples.
GradingPtr make_volume_grading(std::shared_ptr<const DensityBricks> bricks);

}  // namespace lamella
