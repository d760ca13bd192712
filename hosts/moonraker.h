// Moonraker, the host of Klipper machines: https://moonraker.readthedocs.io
#pragma once

#include "hosts/network_host.h"

namespace lamella {

/// Takes files while they are computed: the body may come in chunks, and the SHA-256 after it. `storage` is a
/// folder of its `gcodes` root; empty: the root.
std::unique_ptr<NetworkHost> make_moonraker(const HostAccess& access, const std::string& storage,
                                            const CancelToken* cancel);

}  // namespace lamella
