// Where a user's own settings lie.
#pragma once

#include <string>

namespace lamella {

/// Returns the folder of the user's settings: $XDG_CONFIG_HOME/lamella, or ~/.config/lamella. Empty when
/// neither is known.
std::string user_config_folder();

}  // namespace lamella
