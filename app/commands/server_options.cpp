// Address, folder, token and threads of a server.
#include "app/commands/server_options.h"

#include <cstdio>

namespace lamella {

void add_server_options(CLI::App& command, ServerFlags& flags) {
    command.add_option("--port", flags.port, "Port to listen at; 0: any that is free")
        ->check(CLI::Range(0, 65535));
    command
        .add_option("--listen", flags.address,
                    "Address to listen at; 0.0.0.0 lets other machines in, without encryption. Default: "
                    "127.0.0.1, this machine alone")
        ->type_name("ADDRESS");
    command
        .add_option("--folder", flags.folder,
                    "Folder whose files recipes may use; default: that of the recipe, or the current one")
        ->type_name("DIR");
    command.add_option("--token", flags.token, "Token that requests must carry; default: a random one")
        ->type_name("TEXT");
    command.add_option("--threads", flags.threads, "Threads to use; 0: one per core")
        ->check(CLI::Range(0, 1024));
}

ServerOptions server_options(const ServerFlags& flags) {
    constexpr std::size_t least_token = 16, largest_upload = std::size_t{512} << 20;
    if (!flags.token.empty() && flags.token.size() < least_token)
        throw InputError("--token: too short; accepted: 16 characters or more");
    ServerOptions options;
    options.http.address = flags.address;
    options.http.port = flags.port;
    options.http.token = flags.token.empty() ? random_token() : flags.token;
    options.http.largest_body = largest_upload;
    if (!flags.folder.empty()) options.folder = flags.folder;
    options.threads = flags.threads;
    options.on_delay = [](const std::string& text) { std::fputs((text + "\n").c_str(), stderr); };
    return options;
}

}  // namespace lamella
