// Writes volumes in the NRRD format, which read_nrrd reads again.
#pragma once

#include <array>
#include <filesystem>
#include <span>

#include "engine/base/geometry.h"

namespace lamella {

/// Writes samples (x fastest) that fill a box, mm, as an attached NRRD file of single precision, little
/// endian. The file appears complete or not at all. Throws FaultError when it cannot be written.
void write_nrrd(const std::filesystem::path& file, const std::array<std::size_t, 3>& size,
                std::span<const float> samples, const Box& box);

}  // namespace lamella
