// The two ways, one after the other.
#include "hosts/find_hosts.h"

#include <algorithm>

#include "hosts/mdns_search.h"
#include "hosts/sdcp.h"

namespace lamella {

HostSearch find_hosts(const std::string& address, double seconds, const CancelToken* cancel) {
    HostSearch search;
    if (address.empty()) {
        try {
            search.hosts = find_by_mdns(seconds, cancel);
        } catch (const FaultError& error) {
            search.trouble = error.what();
        }
    }
    for (const SdcpMachine& machine : find_sdcp(address, seconds, cancel))
        search.hosts.push_back({"sdcp+http://" + machine.address, machine.name + ", " + machine.model});
    std::ranges::sort(search.hosts, {}, &FoundHost::named);
    return search;
}

}  // namespace lamella
