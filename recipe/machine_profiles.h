// MachineProfiles: the machines that a recipe can name, built in or from files of the user.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "printers/common/profile.h"

namespace lamella {

/// A machine profile as it was found. Its name is that of its file.
struct MachineProfile {
    PrinterProfile printer;
    std::string description;  ///< one line; may be empty
    std::string source;       ///< "built in", "back-end", or the path of its file
};

/// What a recipe without [printer] gets.
inline constexpr const char* default_profile = "generic-8k";

/// Whether printer.profile names a file instead of a profile.
bool names_profile_file(std::string_view text);

/// Where the user's own profiles lie: $XDG_CONFIG_HOME/lamella/printers, or ~/.config/lamella/printers. Empty
/// when neither is known.
std::string user_profile_folder();

/// Finds profiles by name: in folders of TOML files, then among the built-in ones, then among the back-ends,
/// each of which has its plain settings. A file hides a built-in profile of its name and may be based on it.
class MachineProfiles {
  public:
    /// The built-in profiles alone.
    MachineProfiles();
    /// Looks into a folder before all that is known already. Nothing happens when a folder that need not
    /// exist does not; otherwise throws InputError.
    void add_folder(const std::string& folder, bool must_exist);

    /// All names: profiles in alphabetic order, then the back-ends.
    std::vector<std::string> names() const;
    /// The profile of this name, or in this file; nothing when there is none of this name. Throws InputError,
    /// with every mistake, when its file cannot be used.
    std::optional<MachineProfile> find(const std::string& name) const;
    /// What is wrong with a name that was not found, and what would be right.
    std::string unknown(const std::string& name) const;

  private:
    struct Place {
        std::string name;
        std::string path;       ///< empty for a built-in profile
        std::string_view text;  ///< of a built-in profile
    };
    /// The files that are being read, each based on the next.
    using Chain = std::vector<std::string>;

    std::optional<MachineProfile> find(const std::string& name, std::size_t from, const Chain& chain) const;
    MachineProfile load(const Place& place, std::size_t next, Chain chain) const;

    std::vector<Place> places_;  ///< those that win first
};

}  // namespace lamella
