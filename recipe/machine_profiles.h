// MachineProfiles: the machines that a recipe can name, built in or from the user's files.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "printers/common/profile.h"

namespace lamella {

/// A machine profile with its source. Its name is that of its file.
struct MachineProfile {
    PrinterProfile printer;
    std::string description;  ///< one line; may be empty
    std::string source;       ///< "built in", "back-end", or the path of its file
};

/// The profile of a recipe without [printer].
inline constexpr const char* default_profile = "generic-8k";

/// Returns true if a value of printer.profile is a path rather than a profile's name.
bool names_profile_file(std::string_view text);

/// Returns the folder of the user's own profiles: $XDG_CONFIG_HOME/lamella/printers, or
/// ~/.config/lamella/printers. Empty when neither is known.
std::string user_profile_folder();

/// Profiles by name. They are searched in folders of TOML files, then among the built-in ones, then among the
/// back-ends, each of which has a profile with its defaults. A file hides a built-in profile of its name and
/// may be based on it.
class MachineProfiles {
  public:
    /// Starts with the built-in profiles alone.
    MachineProfiles();
    /// Adds a folder that is searched before all earlier ones. If the folder does not exist, does nothing, or
    /// throws InputError if `must_exist`.
    void add_folder(const std::string& folder, bool must_exist);

    /// Returns all names: profiles in alphabetic order, then back-ends.
    std::vector<std::string> names() const;
    /// Returns the profile with this name or from this file; nothing when the name is unknown. Throws
    /// InputError, listing every mistake, when its file is invalid.
    std::optional<MachineProfile> find(const std::string& name) const;
    /// Returns a message for a name that was not found, with the nearest or accepted names.
    std::string unknown(const std::string& name) const;

  private:
    struct Place {
        std::string name;
        std::string path;       ///< file; empty for a built-in profile
        std::string_view text;  ///< text of a built-in profile
    };
    /// The files being read, each based on the next.
    using Chain = std::vector<std::string>;

    std::optional<MachineProfile> find(const std::string& name, std::size_t from, const Chain& chain) const;
    MachineProfile load(const Place& place, std::size_t next, Chain chain) const;

    std::vector<Place> places_;  ///< in order of precedence
};

}  // namespace lamella
