// OctoPrint, and what answers like it: https://docs.octoprint.org/en/master/api
#pragma once

#include "hosts/network_host.h"

namespace lamella {

/// Asks for the size of a body before it begins. `storage` is `local` or `sdcard`, with a folder or without:
/// local/parts.
std::unique_ptr<NetworkHost> make_octoprint(const HostAccess& access, const std::string& storage,
                                            const CancelToken* cancel);

}  // namespace lamella
