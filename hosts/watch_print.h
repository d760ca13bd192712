// Watches the print of a host until it ends.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "hosts/network_host.h"

namespace lamella {

struct WatchSettings {
    double interval = 2;   ///< between two questions, s
    double patience = 60;  ///< time without an answer after which the host is given up, s
    const CancelToken* cancel = nullptr;
    std::function<void(const HostStatus&)> on_status{};         ///< called after each answer; may be empty
    std::function<void(const std::string& text)> on_trouble{};  ///< called when answers stop; may be empty
};

/// Asks the host for its status until nothing is printed, and returns the last. Throws HostError once the
/// host has not answered for `patience`, Interrupted.
HostStatus watch_print(NetworkHost& host, const WatchSettings& settings);

/// Returns a status as one line: "koala-1a2b.gcode: printing, 42 %, layer 80 of 190, nozzle 215 of 215".
std::string status_text(const HostStatus& status);
/// Returns a status with what is known of it.
nlohmann::ordered_json status_json(const HostStatus& status);

}  // namespace lamella
