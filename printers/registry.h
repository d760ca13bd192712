// The table of back-ends, one row each, and what follows from a profile's row.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "engine/layers/backend.h"
#include "printers/common/layer_heights.h"
#include "printers/common/profile.h"

namespace lamella {

/// Default supports of filament machines.
SupportProfile filament_supports();

/// Default supports of resin machines. Resin is peeled off layer by layer and cannot span a void: more
/// points, thick round pillars, large feet, and tips that break off.
SupportProfile resin_supports();

/// What a back-end leaves behind.
enum class OutputKind : unsigned char { file, folder, file_or_folder };

/// The content of a written layer: pixels of a display, those of a grid about the part, contours or beads.
enum class LayerContent : unsigned char { pixels, voxels, contours, beads };

/// A back-end: everything about it that other code needs to know. No other code than its reader
/// asks for it by name.
struct BackendInfo {
    const char* name;         ///< PrinterProfile::backend
    const char* description;  ///< one line
    const char* endings;  ///< of its files, with their dots, separated by spaces; the first is the default
    OutputKind output;
    std::unique_ptr<Backend> (*make)(const PrinterProfile& profile, const std::string& path, bool force);
    LayerContent content;
    /// The process that its machines work by, where the profile names none.
    Process (*process)(const PrinterProfile& profile);
    /// Supports that suit its machines where nothing else is known.
    SupportProfile (*default_supports)() = filament_supports;
    /// Largest part that its machine takes at this layer height, mm; null where that is not known.
    dvec3 (*build_volume)(const PrinterProfile& profile, double layer_height) = nullptr;
    /// Whether its files hold a picture of the part (Job::picture); null: never.
    bool (*embeds_picture)(const PrinterProfile& profile) = nullptr;
    /// Whether its output is sheets of material to be cut, which take no supports; null: never.
    bool (*cuts_sheets)(const PrinterProfile& profile) = nullptr;
    LayerHeights layer_heights = LayerHeights::any;
    bool streams = false;           ///< writes to standard output as well
    const char* warning = nullptr;  ///< what a recipient of its files should know
};

/// Returns all back-ends.
std::span<const BackendInfo> backends();

/// Returns the width, depth and height of the largest part that a profile's machine takes at this layer
/// height, mm; infinite where that is not known.
dvec3 build_volume_limits(const PrinterProfile& profile, double layer_height);

/// Returns the process that a profile's machine works by: the profile's own, or else that of its back-end.
Process process_of(const PrinterProfile& profile);

/// Throws InputError for layers that differ more in height than a profile's back-end allows; layers that are
/// cut out of sheets are equal.
void check_layer_heights(const PrinterProfile& profile, const LayerPlan& layers);

/// Whether the back-end of a profile turns layers into beads.
bool makes_beads(const PrinterProfile& profile);

/// Whether the output of a profile is sheets of material to be cut.
bool cuts_sheets(const PrinterProfile& profile);

/// Returns by how much a layer may stand out over the one below, mm: as the profile's supports say, or else
/// half the width of a bead, and a layer's height where there are no beads.
double printable_overhang(const PrinterProfile& profile, double layer_height);

/// Returns the row of this name. Throws InputError, with the nearest known name, when there is none.
const BackendInfo& find_backend(std::string_view name);

/// Makes the back-end that a profile names, writing to `output_path`, or to standard output for "-". `force`
/// lets it replace what lamella made there before. Throws InputError.
std::unique_ptr<Backend> make_backend(const PrinterProfile& profile, const std::string& output_path,
                                      bool force);

}  // namespace lamella
