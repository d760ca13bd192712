// Bricks of a surface's pattern in a file.
#pragma once

#include <filesystem>
#include <istream>

#include "procedural/pattern/surface_pattern.h"

namespace lamella {

/// Writes bricks as write_complete_file() does. Numbers are little endian:
///
///     "lamella pattern"     16 bytes with the 0 at the end
///     the rest              a zlib stream, whose end is a checksum (Adler-32):
///       numbers             7 x 8 bytes, double precision: spacing, unit, slope, share, wanted share,
///                           softness before, softness
///       counts              8 x 8 bytes: pieces, joins, bridges, cut struts, detours, hanging, dropped,
///                           bricks
///       corners             3 x 8 bytes a brick
///       steps               729 x 2 bytes a brick
///
/// Throws FaultError when the file cannot be written.
void write_surface_bricks(const std::filesystem::path& file, const SurfaceBricks& bricks);

/// Reads what write_surface_bricks() writes, from a stream whose length is known. Throws InputError ("name:
/// ...") for bytes that are damaged, cut off or followed by more; memory is taken for no more than they can
/// hold.
SurfaceBricks read_surface_bricks(std::istream& in, const std::string& name);

}  // namespace lamella
