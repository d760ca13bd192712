// Volume: numbers on a regular grid, read from an image stack, a multi-page TIFF or an NRRD file.
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Samples in the type of their file.
using VolumeSamples =
    std::variant<std::vector<std::int8_t>, std::vector<std::uint8_t>, std::vector<std::int16_t>,
                 std::vector<std::uint16_t>, std::vector<std::int32_t>, std::vector<std::uint32_t>,
                 std::vector<std::int64_t>, std::vector<std::uint64_t>, std::vector<float>,
                 std::vector<double>>;

/// A grid of samples, x fastest, then y, then z.
struct Volume {
    /// The maximum size of a volume.
    static constexpr std::uint64_t max_voxels = std::uint64_t{1} << 31U;
    static constexpr std::uint64_t max_bytes = std::uint64_t{4} << 30U;

    std::array<std::size_t, 3> size{};  ///< samples along x, y and z, each at least 1
    VolumeSamples samples;
    double full_scale = 1.0;  ///< divisor of the samples: 255 or 65535 for integer images, else 1
    std::optional<Box> box;   ///< its position according to the file, mm; samples are at voxel centres
};

/// Throws InputError("path: ...") for a volume that exceeds the limits.
void check_volume_size(const std::array<std::size_t, 3>& size, std::size_t bytes_each,
                       const std::string& path);

/// Throws InputError unless a box has three positive sides within 1e9 mm of the origin.
void check_volume_box(const Box& box);

/// Reads a volume. Throws InputError with the path.
/// - A folder: all its files except hidden ones are pages, in natural order of names (2 before 10).
/// - A pattern with * and ? in the last part of the path: the matching files, in the same order.
/// - A file whose content is NRRD, attached (.nrrd) or detached (.nhdr).
/// - Any other file: one image, or all pages of a multi-page TIFF.
/// Pages must have the same size and type. Page 0 is lowest in z. The top row of a picture is highest in y,
/// so that a page looks the same seen from above. `channel` counts from 0.
Volume read_volume(const std::string& path, int channel = 0);

/// Reads the luma of a picture, or of pages of pictures, with white under what is transparent; else as
/// read_volume().
Volume read_picture(const std::string& path);

/// Reads the pages of a stack, lowest first, in the given order.
Volume read_image_stack(std::span<const std::string> files, int channel = 0);

/// Reads the NRRD format (teem.sourceforge.net/nrrd/format.html): dimension 3, or 4 with a leading axis of
/// size 1; encodings raw, gzip and text; data attached or in one separate file, which is looked up in
/// `folder`. The box follows from `space directions` along +x, +y, +z with `space origin` (the centre of the
/// first sample), or from `spacings` (its lower corner is the origin then). `name` is used in messages.
Volume read_nrrd(std::istream& in, const std::string& name, const std::string& folder);

}  // namespace lamella
