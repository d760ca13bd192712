// Browsers tell names of services; a resolver tells the address of each.
#include "hosts/mdns_search.h"

#include <avahi-client/client.h>
#include <avahi-client/lookup.h>
#include <avahi-common/address.h>
#include <avahi-common/error.h>
#include <avahi-common/simple-watch.h>
#include <fmt/format.h>

#include <chrono>
#include <map>
#include <memory>

namespace lamella {

namespace {

struct Service {
    const char* type;
    const char* kind;
    int usual_port;
};
constexpr Service services[] = {{"_moonraker._tcp", "moonraker", 80},
                                {"_octoprint._tcp", "octoprint", 80},
                                {"_prusalink._tcp", "prusalink", 80}};
constexpr std::size_t most_hosts = 1000;

/// What has been found, as avahi's callbacks see it.
struct Search {
    AvahiClient* client = nullptr;
    std::map<std::string, std::string> hosts;  // about, by KIND+URL
};

void take_address(AvahiServiceResolver* resolver, AvahiIfIndex /*interface*/, AvahiProtocol /*protocol*/,
                  AvahiResolverEvent event, const char* name, const char* type, const char* /*domain*/,
                  const char* host, const AvahiAddress* /*address*/, std::uint16_t port,
                  AvahiStringList* /*text*/, AvahiLookupResultFlags /*flags*/, void* user) {
    auto& search = *static_cast<Search*>(user);
    if (event == AVAHI_RESOLVER_FOUND && search.hosts.size() < most_hosts) {
        for (const Service& service : services) {
            if (std::string_view(type) != service.type) continue;
            const std::string place = port == service.usual_port ? host : fmt::format("{}:{}", host, port);
            search.hosts[fmt::format("{}+http://{}", service.kind, place)] = name;
        }
    }
    avahi_service_resolver_free(resolver);
}

void take_name(AvahiServiceBrowser* /*browser*/, AvahiIfIndex interface, AvahiProtocol protocol,
               AvahiBrowserEvent event, const char* name, const char* type, const char* domain,
               AvahiLookupResultFlags /*flags*/, void* user) {
    auto& search = *static_cast<Search*>(user);
    if (event != AVAHI_BROWSER_NEW) return;
    avahi_service_resolver_new(search.client, interface, protocol, name, type, domain, AVAHI_PROTO_INET,
                               static_cast<AvahiLookupFlags>(0), take_address, user);
}

void ignore_state(AvahiClient* /*client*/, AvahiClientState /*state*/, void* /*user*/) {}

}  // namespace

std::vector<FoundHost> find_by_mdns(double seconds, const CancelToken* cancel) {
    const std::unique_ptr<AvahiSimplePoll, decltype(&avahi_simple_poll_free)> poll(avahi_simple_poll_new(),
                                                                                   avahi_simple_poll_free);
    int error = 0;
    // Frees its browsers and resolvers, too.
    const std::unique_ptr<AvahiClient, decltype(&avahi_client_free)> client(
        poll ? avahi_client_new(avahi_simple_poll_get(poll.get()), static_cast<AvahiClientFlags>(0),
                                ignore_state, nullptr, &error)
             : nullptr,
        avahi_client_free);
    if (!client)
        throw FaultError(
            fmt::format("mDNS cannot be asked: {}; does avahi-daemon run?", avahi_strerror(error)));
    Search search{client.get(), {}};
    for (const Service& service : services) {
        avahi_service_browser_new(client.get(), AVAHI_IF_UNSPEC, AVAHI_PROTO_INET, service.type, nullptr,
                                  static_cast<AvahiLookupFlags>(0), take_name, &search);
    }
    const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < until) {
        stop_if_cancelled(cancel);
        if (avahi_simple_poll_iterate(poll.get(), 50) != 0) break;
    }
    std::vector<FoundHost> hosts;
    for (const auto& [named, about] : search.hosts) hosts.push_back({named, about});
    return hosts;
}

}  // namespace lamella
