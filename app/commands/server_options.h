// Options of the commands that serve HTTP.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/server/server_state.h"

namespace lamella {

struct ServerFlags {
    std::string address = "127.0.0.1";
    std::string folder;
    std::string token;
    int port = 0;
    int threads = 0;
};

void add_server_options(CLI::App& command, ServerFlags& flags);

/// Returns the options of a server, with a random token where none is given.
ServerOptions server_options(const ServerFlags& flags);

}  // namespace lamella
