// Names, listings and defaults of the machines that a recipe can select.
#pragma once

#include <string>
#include <vector>

#include "engine/base/geometry.h"
#include "printers/registry.h"
#include "recipe/machine_profiles.h"

namespace lamella {

/// Returns the names of all back-ends.
std::vector<std::string> backend_words();

/// Returns the endings of a back-end's files, with their dots; the first is the default.
std::vector<std::string> output_endings(const BackendInfo& backend);

/// Returns the back-end for this path's ending in any case, `preferred` if several share it and it is one of
/// them; empty when no back-end uses the ending.
std::string backend_of_ending(const std::string& path, const std::string& preferred);

/// Ending of the folder of a run without -o.
inline constexpr const char* default_folder_ending = ".layers";
/// Returns the output path of a run without -o: the part's name with the back-end's default ending.
std::string default_output(const PrinterProfile& printer, const std::string& part_name);
/// Returns a listing of back-ends and profiles, with the mistakes of profiles that cannot be used.
std::string printers_listing(const MachineProfiles& profiles);
/// Returns a profile with all its values in the format of a profile file.
std::string profile_as_toml(const MachineProfile& profile);

}  // namespace lamella
