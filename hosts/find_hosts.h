// Finds printers on the local network: by mDNS and by the search of SDCP.
#pragma once

#include <string>
#include <vector>

#include "engine/base/cancel_token.h"

namespace lamella {

/// A printer that has answered.
struct FoundHost {
    std::string named;  ///< KIND+URL, as find_host takes it
    std::string about;  ///< its name for itself
};

struct HostSearch {
    std::vector<FoundHost> hosts;  ///< in the order of their addresses
    std::string trouble;           ///< why one of the ways was not gone; empty: both were
};

/// Asks the local network, or the machine at `address` alone, which then is asked by SDCP only, for this
/// time, s. Throws Interrupted.
HostSearch find_hosts(const std::string& address, double seconds, const CancelToken* cancel);

}  // namespace lamella
