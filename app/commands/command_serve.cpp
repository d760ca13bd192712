// `lamella serve`: answers other programs through a pipe.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
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

}  // namespace

void add_serve_command(CLI::App& root) {
    CLI::App& command =
        *root.add_subcommand("serve", "Answer requests of another program for sections, through a pipe");
    auto stdio = std::make_shared<bool>(false);
    command
        .add_flag("--stdio", *stdio, "Read requests from standard input, write replies to standard output")
        ->required();
    finish_command(command,
                   "  lamella serve --stdio\n"
                   "A request is its length (4 bytes, little-endian) followed by that many bytes of JSON. A "
                   "reply has the\n"
                   "same form, followed by `bytes` bytes of numbers. docs/embedding/server.md describes the "
                   "methods.");
    command.callback([] { run(); });
}

}  // namespace lamella
