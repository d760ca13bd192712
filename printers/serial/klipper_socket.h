// Klipper's API sockets on this computer.
#pragma once

#include <string>
#include <vector>

namespace lamella {

/// Returns true if a path leads to a socket.
bool is_socket(const std::string& path);

/// Returns the API sockets that exist in the usual places: ~/printer_data*/comms/klippy.sock (also below
/// /home), /run/klipper/ and /tmp/klippy_uds. Connects to none of them.
std::vector<std::string> klipper_sockets();

}  // namespace lamella
