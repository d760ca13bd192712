// `lamella serve`: answers other programs through a pipe, or by HTTP.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/commands/server_options.h"
#include "app/console/interrupt.h"
#include "app/console/text_output.h"
#include "app/reports/section_server.h"
#include "engine/base/error.h"

namespace lamella {

namespace {

constexpr std::size_t longest_request = std::size_t{64} << 20;

/// Reads the next length from standard input, 4 bytes, little-endian; returns nothing when the input ends
/// between requests.
std::optional<std::size_t> read_length() {
    std::array<unsigned char, 4> bytes{};
    const std::size_t got = std::fread(bytes.data(), 1, bytes.size(), stdin);
    if (got == 0) return std::nullopt;
    if (got < bytes.size()) throw InputError("standard input ends within the length of a request");
    return bytes[0] | std::size_t{bytes[1]} << 8 | std::size_t{bytes[2]} << 16 | std::size_t{bytes[3]} << 24;
}

std::optional<std::string> read_request() {
    const std::optional<std::size_t> length = read_length();
    if (!length) return std::nullopt;
    if (*length > longest_request) {
        throw InputError(
            fmt::format("a request of {} bytes is too large; accepted: up to {} bytes, each request preceded "
                        "by its length as 4 bytes, little-endian",
                        *length, longest_request));
    }
    std::string text(*length, '\0');
    if (std::fread(text.data(), 1, text.size(), stdin) < text.size())
        throw InputError("standard input ends within a request");
    return text;
}

void write_reply(TextOutput& out, const ServerReply& reply) {
    const std::string head = reply.head.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::string length;
    for (int shift = 0; shift < 32; shift += 8) length += static_cast<char>(head.size() >> shift & 0xff);
    out.write(length + head + reply.body);
    out.flush();
}

void run() {
    SectionServer server;
    TextOutput out("");
    while (!server.has_ended()) {
        const std::optional<std::string> request = read_request();
        if (!request) break;
        write_reply(out, server.answer(*request));
    }
    out.close();
}

struct ServeCommand {
    bool stdio = false, http = false;
    ServerFlags server;
};

void run_http(const ServerFlags& flags) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    serve_http(server_options(flags), cancel, [](const std::string& address) {
        std::fputs((address + "\n").c_str(), stdout);
        std::fflush(stdout);
    });
}

}  // namespace

void add_serve_command(CLI::App& root) {
    CLI::App& command = *root.add_subcommand(
        "serve", "Answer requests of other programs for jobs and layers, through a pipe or by HTTP");
    auto options = std::make_shared<ServeCommand>();
    CLI::Option* stdio = command.add_flag(
        "--stdio", options->stdio, "Read requests from standard input, write replies to standard output");
    command.add_flag("--http", options->http, "Listen for HTTP, and print the address with its token")
        ->excludes(stdio);
    add_server_options(command, options->server);
    finish_command(command,
                   "  lamella serve --stdio\n"
                   "  lamella serve --http --port 8080 --folder models\n"
                   "A request is its length (4 bytes, little-endian) followed by that many bytes of JSON. A "
                   "reply has the\n"
                   "same form, followed by `bytes` bytes of numbers. docs/embedding/server.md describes the "
                   "methods, docs/embedding/http.md the interface by HTTP.");
    command.callback([options] {
        if (options->http) {
            run_http(options->server);
        } else if (options->stdio) {
            run();
        } else {
            throw InputError("serve: no way to listen is given; accepted: --stdio or --http");
        }
    });
}

}  // namespace lamella
