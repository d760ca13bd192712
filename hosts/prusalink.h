// PrusaLink, in Prusa's machines and beside older ones: https://github.com/prusa3d/Prusa-Link-Web (spec)
#pragma once

#include "hosts/network_host.h"

namespace lamella {

/// Asks for the size of a body before it begins. With a user, the key is the password of digest
/// authentication; without, it is sent as X-Api-Key. `storage` is `usb`, `local` or `sdcard`, with a folder
/// or without.
std::unique_ptr<NetworkHost> make_prusalink(const HostAccess& access, const std::string& storage,
                                            const CancelToken* cancel);

}  // namespace lamella
