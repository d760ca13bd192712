// Density bricks in a file.
#pragma once

#include <filesystem>
#include <istream>

#include "procedural/volume/density_bricks.h"

namespace lamella {

/// Writes bricks as write_complete_file() does. Numbers are little endian:
///
///     "lamella bricks1"     16 bytes with the 0 at the end
///     the rest              a zlib stream, whose end is a checksum (Adler-32):
///       size                3 x 4 bytes: voxels along x, y and z
///       box                 6 x 8 bytes, double precision: lower, then upper corner, mm
///       bricks              a byte each, x fastest: 0 for one sample, 1 for all of them
///       samples             single precision, one brick after the other; the lowest bytes of all samples
///                           first, the highest bytes last, which packs them smaller
///
/// Throws FaultError when the file cannot be written.
void write_bricks(const std::filesystem::path& file, const DensityBricks& bricks);

/// Reads what write_bricks() writes, from a stream whose length is known. Throws InputError ("name: ...") for
/// bytes that are damaged, cut off or followed by more; memory is taken for no more than they can hold.
DensityBricks read_bricks(std::istream& in, const std::string& name);

}  // namespace lamella
