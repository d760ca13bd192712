// Printing: ports, the start of a print, its state, and requests to it.
#include "app/server/server_state.h"
#include "printers/serial/klipper_socket.h"
#include "printers/serial/serial_port.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

Json ports_json() {
    Json list = Json::array();
    for (const PortInfo& port : serial_ports())
        list.push_back({{"path", port.path}, {"by_id", port.by_id}, {"description", port.description}});
    for (const std::string& socket : klipper_sockets())
        list.push_back({{"path", socket}, {"by_id", ""}, {"description", "API socket of Klipper"}});
    return list;
}

std::size_t button_of(const HttpRequest& request) {
    constexpr std::int64_t most = 64;
    const Json json = request.json();
    const Json button = json.contains("button") ? json["button"] : Json();
    if (!button.is_number_integer() || button.get<std::int64_t>() < 0 || button.get<std::int64_t>() > most)
        throw HttpError(400, "button: accepted: the number of a button of the question, from 0");
    return button.get<std::size_t>();
}

}  // namespace

void add_print_routes(ServerState& state) {
    HttpServer& http = state.http;
    ServedPrinter& printer = state.printer;
    const auto order = [&](const std::string& path, void (ServedPrint::*what)()) {
        http.route("POST", path, [&printer, what](const HttpRequest&) -> HttpReply {
            return printer.tell([what](ServedPrint& print) { (print.*what)(); });
        });
    };
    http.route("GET", "/api/ports", [](const HttpRequest&) -> HttpReply { return ports_json(); });
    http.route("GET", "/api/jobs/{job}/print", [&state](const HttpRequest& request) -> HttpReply {
        return state.printer.outlook(*state.jobs.find(request.parts.at("job")));
    });
    http.route("POST", "/api/jobs/{job}/print", [&state](const HttpRequest& request) -> HttpReply {
        auto job = state.jobs.find(request.parts.at("job"));
        return {state.printer.start(std::move(job), request.json()), 202};
    });
    http.route("GET", "/api/print",
               [&printer](const HttpRequest&) -> HttpReply { return printer.describe(); });
    http.route("GET", "/api/print/messages",
               [&printer](const HttpRequest&) -> HttpReply { return printer.messages(); });
    order("/api/print/pause", &ServedPrint::pause);
    order("/api/print/resume", &ServedPrint::resume);
    order("/api/print/stop", &ServedPrint::stop);
    order("/api/print/halt", &ServedPrint::halt);
    http.route("POST", "/api/print/choose", [&printer](const HttpRequest& request) -> HttpReply {
        return printer.tell([&](ServedPrint& print) { print.choose(button_of(request)); });
    });
}

}  // namespace lamella
