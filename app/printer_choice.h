// The machines that a recipe can name: back-ends and profiles, as words.
#pragma once

#include <string>
#include <vector>

#include "engine/geometry.h"
#include "printers/profile.h"

namespace lamella {

/// Names of all back-ends.
std::vector<std::string> backend_words();
/// Names of all profiles, then those of the back-ends.
std::vector<std::string> profile_words();
/// What a recipe without [printer] gets.
PrinterProfile default_profile();
/// The profile of this name; the default profile with this back-end when it is a back-end's name. Throws
/// InputError when it is neither.
PrinterProfile profile_named(const std::string& name);

/// What the machine can print on, x and y in mm; infinite where it has no bounds.
dvec2 plate_size(const PrinterProfile& printer);

/// The back-end that files with this path's ending are for; empty where the ending says nothing.
std::string backend_of_ending(const std::string& path);

/// Where a run without -o writes: the part's name, with the back-end's usual ending.
std::string default_output(const PrinterProfile& printer, const std::string& part_name);
/// Back-ends and profiles as text for people.
std::string printers_listing();

}  // namespace lamella
