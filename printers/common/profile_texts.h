// The machine profiles that ship with the program, as the text of their TOML files.
#pragma once

#include <span>
#include <string_view>

namespace lamella {

/// A file of printers/profiles: its name without the ending, and what stands in it.
struct ProfileText {
    std::string_view name;
    std::string_view text;
};

/// All of them by name; made from the files when the program is built.
std::span<const ProfileText> profile_texts();

}  // namespace lamella
