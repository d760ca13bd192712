// Reads the request for a print, member by member.
#include "app/server/print_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/http/http_server.h"
#include "engine/base/error.h"
#include "printers/serial/klipper_socket.h"
#include "printers/serial/serial_output.h"
#include "printers/serial/serial_port.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

/// Members of an object, each with its own message where it is not accepted.
class PrintMembers {
  public:
    PrintMembers(const Json& json, std::string place, const std::vector<std::string>& accepted)
        : json_(json), place_(std::move(place)) {
        for (const auto& [name, value] : json.items()) {
            if (std::ranges::find(accepted, name) == accepted.end())
                throw HttpError(400, fmt::format("{}{}: unknown; accepted: {}", place_, name.substr(0, 32),
                                                 fmt::join(accepted, ", ")));
        }
    }
    bool has(const char* name) const { return json_.contains(name) && !json_[name].is_null(); }
    void read(const char* name, bool& value) const {
        if (!has(name)) return;
        if (!json_[name].is_boolean()) refuse(name, "true or false");
        value = json_[name].get<bool>();
    }
    double number(const char* name, double usual, double least, double most) const {
        return has(name) ? number_of(json_[name], name, least, most) : usual;
    }
    int integer(const char* name, int usual, int least, int most) const {
        if (!has(name)) return usual;
        if (!json_[name].is_number_integer())
            refuse(name, fmt::format("a whole number from {} to {}", least, most));
        return static_cast<int>(number_of(json_[name], name, least, most));
    }
    /// Reads a place on the bed, mm.
    void read(const char* name, double& x, double& y) const {
        if (!has(name)) return;
        const Json& pair = json_[name];
        if (!pair.is_array() || pair.size() != 2) refuse(name, "X and Y in mm, such as [0, 200]");
        constexpr double farthest = 10000;
        x = number_of(pair[0], name, -farthest, farthest);
        y = number_of(pair[1], name, -farthest, farthest);
    }
    [[noreturn]] void refuse(const char* name, const std::string& accepted) const {
        throw HttpError(400, fmt::format("{}{}: accepted: {}", place_, name, accepted));
    }

  private:
    double number_of(const Json& value, const char* name, double least, double most) const {
        const bool fits = value.is_number() && value.get<double>() >= least && value.get<double>() <= most;
        if (!fits) refuse(name, fmt::format("a number from {} to {}", least, most));
        return value.get<double>();
    }

    const Json& json_;
    std::string place_;
};

/// Returns the port, if it is one. No other file may be opened by way of it, and no other socket.
std::string port_of(const Json& to) {
    const Json name = to.contains("serial") ? to["serial"] : Json();
    std::string path = name.is_string() ? name.get<std::string>() : "";
    const std::string accepted = "accepted: the path of a serial port below /dev, or one of GET /api/ports";
    const std::vector<std::string> sockets = klipper_sockets();
    if (std::ranges::find(sockets, path) != sockets.end()) return path;
    if (!path.starts_with("/dev/") || path.find('\0') != std::string::npos || path.size() > 255)
        throw HttpError(400, "to.serial: " + accepted);
    std::error_code error;
    if (!std::filesystem::exists(path, error))
        throw HttpError(404, fmt::format("to.serial: there is no port {}; {}", path, accepted));
    if (!is_serial_line(path)) throw HttpError(400, fmt::format("to.serial: {} is none; {}", path, accepted));
    return path;
}

void read_serial_line(const Json& to, LinkSettings& link) {
    const PrintMembers line(
        to, "to.",
        {"serial", "baud", "reset", "send_window", "ping_pong", "within_slots", "greeting", "reconnect"});
    constexpr int slowest = 1200, fastest = 4000000, least_window = 64, most_window = 65536;
    constexpr double longest_greeting = 60, longest_loss = 86400;  // s
    link.port = port_of(to);
    link.baud = line.integer("baud", link.baud, slowest, fastest);
    line.read("reset", link.reset_board);
    SenderSettings& sender = link.sender;
    sender.window = static_cast<std::size_t>(
        line.integer("send_window", static_cast<int>(sender.window), least_window, most_window));
    line.read("ping_pong", sender.ping_pong);
    line.read("within_slots", sender.within_slots);
    sender.greeting = line.number("greeting", sender.greeting, 0, longest_greeting);
    link.reconnect_for = line.number("reconnect", link.reconnect_for, 0, longest_loss);
}

}  // namespace

PrintRequest read_print_request(const Json& body, const PrinterProfile& printer) {
    const PrintMembers members(body, "", {"to", "park", "resume", "resume_z", "discard_journal"});
    if (!members.has("to") || !body["to"].is_object())
        members.refuse("to", R"(where to print, such as {"serial": "/dev/ttyUSB0", "baud": 250000})");
    PrintRequest request;
    suit_printer(request.link, printer);
    read_serial_line(body["to"], request.link);
    try {
        choose_dialect(request.link, "", &printer);
    } catch (const InputError& error) {
        throw HttpError(400, error.what());
    }
    members.read("park", request.link.park_x, request.link.park_y);
    members.read("resume", request.resume);
    members.read("discard_journal", request.discard_journal);
    constexpr double highest = 10000;
    if (members.has("resume_z")) request.z = members.number("resume_z", 0, 0, highest);
    if (request.z && !request.resume) members.refuse("resume_z", "only with \"resume\": true");
    if (request.resume && request.discard_journal)
        members.refuse("discard_journal", "not with \"resume\": true, which needs the journal");
    return request;
}

}  // namespace lamella
