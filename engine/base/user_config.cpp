// By the XDG Base Directory Specification 0.8.
#include "engine/base/user_config.h"

#include <cstdlib>

namespace lamella {

std::string user_config_folder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nothing sets it
        return std::string(value ? value : "");
    };
    // A relative path must be ignored.
    if (const std::string config = variable("XDG_CONFIG_HOME"); config.starts_with('/'))
        return config + "/lamella";
    const std::string home = variable("HOME");
    return home.empty() ? "" : home + "/.config/lamella";
}

}  // namespace lamella
