// Printers on the network: which the user knows, what they do, requests to them, and jobs sent to them.
#include "app/server/server_state.h"
#include "engine/base/error.h"
#include "hosts/known_hosts.h"
#include "hosts/watch_print.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

/// Names and addresses; never a key.
Json hosts_json() {
    Json list = Json::array();
    for (const KnownHost& host : read_hosts(hosts_file()))
        list.push_back({{"name", host.access.name}, {"kind", host.kind->name}, {"url", host.access.url}});
    return {{"file", hosts_file()}, {"hosts", list}};
}

/// Calls what(host) with the host of the request's path, and tells the host's failures as 502.
template <typename What>
HttpReply with_host(const HttpRequest& request, const What& what) {
    const std::string& name = request.parts.at("host");
    try {
        if (const auto host = known_host(name)) return what(*host->connect(nullptr));
    } catch (const HostError& error) {
        throw HttpError(502, error.what());
    } catch (const InputError& error) {
        throw HttpError(502, error.what());
    }
    throw HttpError(404, "there is no such host in " + hosts_file());
}

Json describe_host(NetworkHost& host) {
    const HostFacts facts = host.facts();
    Json json{{"software", facts.software}, {"machine", facts.machine}, {"encrypted", !host.is_plain()}};
    if (facts.free_bytes) json["free_bytes"] = *facts.free_bytes;
    if (!facts.formats.empty()) json["formats"] = facts.formats;
    json["status"] = status_json(host.status());
    return json;
}

}  // namespace

void add_host_routes(ServerState& state) {
    HttpServer& http = state.http;
    const auto order = [&](const std::string& what, void (NetworkHost::*call)()) {
        http.route("POST", "/api/hosts/{host}/" + what, [call](const HttpRequest& request) {
            return with_host(request, [call](NetworkHost& host) -> HttpReply {
                (host.*call)();
                return status_json(host.status());
            });
        });
    };
    http.route("GET", "/api/hosts", [](const HttpRequest&) -> HttpReply { return hosts_json(); });
    http.route("GET", "/api/hosts/{host}", [](const HttpRequest& request) {
        return with_host(request, [](NetworkHost& host) -> HttpReply { return describe_host(host); });
    });
    http.route("GET", "/api/hosts/{host}/status", [](const HttpRequest& request) {
        return with_host(request, [](NetworkHost& host) -> HttpReply { return status_json(host.status()); });
    });
    order("pause", &NetworkHost::pause);
    order("resume", &NetworkHost::resume);
    order("cancel", &NetworkHost::cancel);
    http.route("POST", "/api/jobs/{job}/send", [&state](const HttpRequest& request) -> HttpReply {
        auto job = state.jobs.find(request.parts.at("job"));
        return {state.sending.start(std::move(job), request.json()), 202};
    });
    http.route("GET", "/api/sending",
               [&state](const HttpRequest&) -> HttpReply { return state.sending.describe(); });
    http.route("DELETE", "/api/sending", [&state](const HttpRequest&) -> HttpReply {
        state.sending.cancel();
        return state.sending.describe();
    });
}

}  // namespace lamella
