// Duet and other boards of RepRapFirmware 3, alone or with a single-board computer.
#pragma once

#include "hosts/network_host.h"

namespace lamella {

/// Asks for size and CRC-32 of a body before it begins. The key is the machine's password. `storage` is a
/// folder, such as 0:/gcodes.
std::unique_ptr<NetworkHost> make_duet(const HostAccess& access, const std::string& storage,
                                       const CancelToken* cancel);

}  // namespace lamella
