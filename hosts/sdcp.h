// SDCP 3, spoken by resin machines with boards of CBD: Elegoo and others.
// https://github.com/cbd-tech/SDCP-Smart-Device-Control-Protocol-V3.0.0
#pragma once

#include "hosts/network_host.h"

namespace lamella {

/// Asks for size and MD5 of a file before its first part. Nothing is encrypted, and nobody is asked who they
/// are. `storage` is `local` or `usb`. The address may leave out the port, 3030.
std::unique_ptr<NetworkHost> make_sdcp(const HostAccess& access, const std::string& storage,
                                       const CancelToken* cancel);

/// A machine that has answered a search.
struct SdcpMachine {
    std::string name, model, address, board;
};

/// Asks one address, or all machines of the local network by broadcast, who they are, and collects the
/// answers that come within this time, s.
std::vector<SdcpMachine> find_sdcp(const std::string& address, double seconds, const CancelToken* cancel);

}  // namespace lamella
