// Profiles of machines that ship with the program, as the text of their TOML files.
#pragma once

#include <span>
#include <string_view>

namespace lamella {

/// A file of printers/profiles: its name without the extension, and its text.
struct ProfileText {
    std::string_view name;
    std::string_view text;
};

/// Returns all profiles, sorted by name. Generated from the files when the program is built.
std::span<const ProfileText> profile_texts();

}  // namespace lamella
