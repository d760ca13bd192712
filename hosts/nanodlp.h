// NanoDLP, the host of many resin machines: https://github.com/nanodlp/api-docs
#pragma once

#include "hosts/network_host.h"

namespace lamella {

/// Takes its own files, as plates. `storage` is the number of the resin profile that plates are printed with.
std::unique_ptr<NetworkHost> make_nanodlp(const HostAccess& access, const std::string& storage,
                                          const CancelToken* cancel);

}  // namespace lamella
