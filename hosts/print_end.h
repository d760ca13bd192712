// What happens when a print has ended: a command of the user's, a message to an address.
#pragma once

#include <string>
#include <vector>

#include "hosts/network_host.h"

namespace lamella {

/// Who is told of the end of a print.
struct EndNotice {
    std::vector<std::string> command{};  ///< program and arguments, run without a shell; empty: none
    std::string webhook{};               ///< gets JSON by POST; empty: none
};

/// Tells that a host's print has ended. The command finds LAMELLA_HOST, LAMELLA_FILE and LAMELLA_STATE in its
/// environment; the address gets {"host": ..., "file": ..., "state": ...}. Waits for the command. Throws
/// FaultError when it cannot be run or fails, HostError when the address does not answer.
void tell_end(const EndNotice& notice, const std::string& host, const HostStatus& status);

}  // namespace lamella
