// Printing by HTTP over the socket of a simulated klippy.
#include <algorithm>
#include <cstdlib>

#include "tests/app/commands/mentions.h"
#include "tests/app/server/printing_server.h"
#include "tests/printers/serial/klipper_on_socket.h"

namespace print_klipper_routes_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

const std::string klipper_ball =
    "[part]\nshape = \"sphere\"\nradius = 2.5\n[layers]\nheight = 0.25\n[printer]\nprofile = \"klipper\"\n";

/// A home with a socket in its usual place; the one before comes back in the end.
class HomeWithSocket {
  public:
    explicit HomeWithSocket(const KlipperOnSocket& machine) {
        fs::create_directories(folder_ / "printer_data/comms");
        fs::rename(machine.path(), path());
        setenv("HOME", folder_.path().c_str(), 1);
    }
    ~HomeWithSocket() { setenv("HOME", before_.c_str(), 1); }
    std::string path() const { return folder_ / "printer_data/comms/klippy.sock"; }

  private:
    static std::string home() {
        const char* home = std::getenv("HOME");
        return home != nullptr ? home : "/";
    }
    Folder folder_;
    std::string before_ = home();
};

}  // namespace

TEST_CASE("a socket of Klipper is a port, and prints a job as its file says", "[server]") {
    KlipperOnSocket machine({}, 30);
    const HomeWithSocket home(machine);
    const RunningServer server;
    const Json ports = server.json("GET", "/api/ports");
    const auto socket = std::find_if(ports.begin(), ports.end(),
                                     [&](const Json& port) { return port["path"] == home.path(); });
    REQUIRE(socket != ports.end());
    CHECK((*socket)["description"] == "API socket of Klipper");

    const std::string job = server.build(klipper_ball);
    const int output = server.json("POST", "/api/jobs/" + job + "/outputs", Json::object(), 202)["output"];
    const std::string address = "/api/outputs/" + std::to_string(output);
    REQUIRE(wait_for(60, [&] { return server.json("GET", address)["state"] == "done"; }));
    std::istringstream in(server.send("GET", address + "/file")->body);
    std::vector<std::string> wanted;
    for (std::string line; std::getline(in, line);) {
        if (const std::string command = clean_command(line, klipper_lines); !command.empty())
            wanted.push_back(command);
    }
    wanted.emplace_back("M400");

    server.json("POST", "/api/jobs/" + job + "/print", {{"to", {{"serial", home.path()}}}}, 202);
    REQUIRE(wait_for(60, [&] {
        const std::string state = server.json("GET", "/api/print")["state"];
        return state == "done" || state == "failed";
    }));
    const Json end = server.json("GET", "/api/print");
    CHECK(end["state"] == "done");
    CHECK(mentions(end["firmware"].get<std::string>(), "Klipper v0.12.0"));
    CHECK(first_difference(machine.executed(), wanted) == "");
}

TEST_CASE("a socket is opened for a machine with Klipper, and no other socket is", "[server]") {
    KlipperOnSocket machine({}, 30), hidden({}, 30);
    const HomeWithSocket home(machine);
    const RunningServer server;
    const auto refused = [&](const std::string& job, const std::string& path) {
        const Json reply =
            server.json("POST", "/api/jobs/" + job + "/print", {{"to", {{"serial", path}}}}, 400);
        return reply["message"].get<std::string>();
    };
    CHECK(mentions(refused(server.build(marlin_ball), home.path()), "--printer klipper"));
    CHECK(mentions(refused(server.build(klipper_ball), hidden.path()), "GET /api/ports"));
    CHECK(server.json("GET", "/api/print")["state"] == "none");
}

}  // namespace print_klipper_routes_test
