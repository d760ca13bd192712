// The search by mDNS (RFC 6762), through this computer's avahi-daemon.
#pragma once

#include <vector>

#include "hosts/find_hosts.h"

namespace lamella {

/// Looks for the services of Moonraker, OctoPrint and PrusaLink for this time, s. Throws FaultError where no
/// daemon answers, Interrupted.
std::vector<FoundHost> find_by_mdns(double seconds, const CancelToken* cancel);

}  // namespace lamella
