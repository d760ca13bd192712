// The machines that a recipe can name, as words and text for people.
#pragma once

#include <string>
#include <vector>

#include "engine/base/geometry.h"
#include "recipe/machine_profiles.h"

namespace lamella {

/// Names of all back-ends.
std::vector<std::string> backend_words();

/// What the machine can print on, x and y in mm; infinite where it has no bounds.
dvec2 plate_size(const PrinterProfile& printer);

/// The back-end that files with this path's ending are for, `preferred` if it is one of them; empty where the
/// ending says nothing.
std::string backend_of_ending(const std::string& path, const std::string& preferred);

/// Where a run without -o writes: the part's name, with the back-end's usual ending.
std::string default_output(const PrinterProfile& printer, const std::string& part_name);
/// Back-ends and profiles as text for people, with what is wrong with those that cannot be used.
std::string printers_listing(const MachineProfiles& profiles);
/// A profile with all its values, as the text of a profile's file.
std::string profile_as_toml(const MachineProfile& profile);

}  // namespace lamella
