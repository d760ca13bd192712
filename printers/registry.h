// The back-ends, by name.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// What a back-end leaves behind.
enum class OutputKind : unsigned char { file, folder, file_or_folder };

/// What a back-end makes of a layer: pixels of a display, those of a grid about the part, contours or beads.
enum class LayerContent : unsigned char { pixels, voxels, contours, beads };

struct BackendInfo {
    const char* name;         ///< PrinterProfile::backend
    const char* description;  ///< one line
    const char* endings;  ///< of its files, with their dots, separated by spaces; the first is the usual one
    OutputKind output;
    std::unique_ptr<Backend> (*make)(const PrinterProfile& profile, const std::string& path, bool force);
    LayerContent medium = LayerContent::pixels;
    bool streams = false;           ///< writes to standard output as well
    const char* warning = nullptr;  ///< what whoever gets such an output should know
    /// Largest part that its machine takes at this layer height, mm; null where that is not known.
    dvec3 (*build_volume)(const PrinterProfile& profile, double layer_height) = nullptr;
};

/// All back-ends.
std::span<const BackendInfo> backends();

/// Supports as a back-end's machines need them where nothing else is known. Resin is peeled off layer by
/// layer and cannot span a void: more points, thick round pillars, large feet, and tips that break off.
SupportProfile default_supports(std::string_view backend);

/// Width, depth and height of what a profile's machine has room for at this height of layers, as its
/// back-end takes it, mm; infinite where that is not known.
dvec3 build_volume_limits(const PrinterProfile& profile, double layer_height);

/// Throws InputError, with the nearest known name, when there is none of this name.
const BackendInfo& find_backend(std::string_view name);

/// The back-end that a profile names, writing to `output_path`, or to standard output for "-". `force` lets
/// it replace what lamella made there before. Throws InputError.
std::unique_ptr<Backend> make_backend(const PrinterProfile& profile, const std::string& output_path,
                                      bool force);

}  // namespace lamella
