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
    /// The largest volume that is read.
    static constexpr std::uint64_t max_voxels = std::uint64_t{1} << 31U;
    static constexpr std::uint64_t max_bytes = std::uint64_t{4} << 30U;

    std::array<std::size_t, 3> size{};  ///< samples along x, y and z, each at least 1
    VolumeSamples samples;
    double full_scale = 1.0;  ///< what a sample is divided by: 255 or 65535 for integer images, else 1
    std::optional<Box> box;   ///< where the file says it lies, mm: voxels are centred on their samples
};

/// Throws InputError("path: ...") for a volume beyond the limits.
void check_volume_size(const std::array<std::size_t, 3>& size, std::size_t bytes_each,
                       const std::string& path);

/// Reads a volume. Throws InputError with the path.
/// - a folder: all its files but hidden ones as pages; names sort naturally, 2 before 10
/// - a pattern with * and ? in the last part of the path: the files whose name fits, sorted likewise
/// - a file whose content is NRRD, attached (.nrrd) or detached (.nhdr)
/// - any other file: one image, or all pages of a multi-page TIFF
/// Pages are alike in size and type. Page 0 lies lowest in z; the top row of a picture lies highest in y, so
/// that a page looks the same seen from above. `channel` counts from 0.
Volume read_volume(const std::string& path, int channel = 0);

/// The pages of a stack, lowest first, as they are given.
Volume read_image_stack(std::span<const std::string> files, int channel = 0);

/// Reads the NRRD format (teem.sourceforge.net/nrrd/format.html): dimension 3, or 4 with a leading axis of
/// size 1; encodings raw, gzip and text; data attached or in one file of its own, which is looked for in
/// `folder`. The box is known from `space directions` along +x, +y, +z with `space origin` (the centre of the
/// first sample), or from `spacings` (then its lower corner is the origin). `name` stands in messages.
Volume read_nrrd(std::istream& in, const std::string& name, const std::string& folder);

}  // namespace lamella
