// A server that prints to a simulated machine behind a pseudo-terminal.
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "printers/serial/gcode_line.h"
#include "tests/app/server/running_server.h"
#include "tests/printers/serial/pty_machine.h"
#include "tests/wait_for.h"

namespace lamella {

inline const std::string marlin_ball =
    "[part]\nshape = \"sphere\"\nradius = 2.5\n[layers]\nheight = 0.25\n[printer]\nprofile = \"marlin\"\n";

/// Lines of G-code as a printer gets them.
inline std::vector<std::string> clean_lines_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) {
        if (const std::string command = clean_command(line); !command.empty()) lines.push_back(command);
    }
    return lines;
}

/// A running server with a job, and a machine to print it.
class PrintingServer : public RunningServer {
  public:
    explicit PrintingServer(test::FirmwareOptions firmware = {}, double pace = 30)
        : machine(firmware, pace), job(build(marlin_ball)) {}

    /// The body of a request for a print.
    Json request(const Json& more = Json::object()) const {
        Json body{{"to", {{"serial", machine.path()}, {"greeting", 0.2}}}};
        if (more.is_object()) body.update(more);
        return body;
    }
    Json start(const Json& more = Json::object(), int status = 202) const {
        return json("POST", "/api/jobs/" + job + "/print", request(more), status);
    }
    Json print() const { return json("GET", "/api/print"); }
    Json order(const std::string& what, int status = 200) const {
        return json("POST", "/api/print/" + what, nullptr, status);
    }
    bool reaches(const std::string& state) const {
        return wait_for(60, [&] { return print()["state"] == state; });
    }
    /// Waits until a layer and more is printed.
    bool prints_layer(int layer) const {
        return wait_for(60, [&] {
            const Json now = print();
            return now["layer"].is_number() && now["layer"] >= layer;
        });
    }
    /// Lines of the job's file.
    std::vector<std::string> file_lines() const {
        const int output = json("POST", "/api/jobs/" + job + "/outputs", Json::object(), 202)["output"];
        const std::string address = "/api/outputs/" + std::to_string(output);
        REQUIRE(wait_for(60, [&] { return json("GET", address)["state"] == "done"; }));
        return clean_lines_of(send("GET", address + "/file")->body);
    }
    bool is_hot() {
        return machine.with([](test::SimulatedMarlin& printer, double) { return printer.heating(); });
    }
    std::string journal() const { return folder() / "sphere.print.journal"; }

    test::PtyMachine machine;
    std::string job;
};

}  // namespace lamella
