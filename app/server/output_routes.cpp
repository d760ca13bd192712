// Outputs: files that are sliced in the background.
#include <charconv>
#include <fstream>

#include "app/server/server_state.h"
#include "engine/base/whole_file.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

int number_of(const HttpRequest& request) {
    const std::string& text = request.parts.at("output");
    int number = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
    if (parsed.ec != std::errc{} || parsed.ptr != text.data() + text.size())
        throw HttpError(404, "there is no such output");
    return number;
}

HttpReply start(ServerState& state, const HttpRequest& request) {
    const auto job = state.jobs.find(request.parts.at("job"));
    const Json json = request.body.empty() ? Json::object() : request.json();
    const auto text = [&](const char* name) {
        if (!json.contains(name) || json[name].is_null()) return std::string();
        if (!json[name].is_string()) throw HttpError(400, std::string(name) + ": accepted: a text");
        return json[name].get<std::string>();
    };
    const int number = state.outputs.start(job, text("file"), text("session"));
    return {state.outputs.describe(number), 202};
}

/// Sends a file in pieces, so that its size does not matter.
HttpReply send_file(const std::filesystem::path& path) {
    HttpReply reply("application/octet-stream", "");
    reply.file_name = path.filename().string();
    auto in = std::make_shared<std::ifstream>(path, std::ios::binary);
    if (!*in) throw HttpError(404, "the file is gone");
    reply.length = std::filesystem::file_size(path);
    reply.stream = [in, piece = std::string()](const HttpSink& sink) mutable {
        constexpr std::size_t piece_size = 1 << 18;
        piece.resize(piece_size);
        in->read(piece.data(), static_cast<std::streamsize>(piece.size()));
        piece.resize(static_cast<std::size_t>(in->gcount()));
        return !piece.empty() && sink(piece);
    };
    return reply;
}

}  // namespace

void add_output_routes(ServerState& state) {
    HttpServer& http = state.http;
    http.route("POST", "/api/jobs/{job}/outputs",
               [&state](const HttpRequest& request) { return start(state, request); });
    http.route("GET", "/api/outputs/{output}", [&state](const HttpRequest& request) -> HttpReply {
        return state.outputs.describe(number_of(request));
    });
    http.route("DELETE", "/api/outputs/{output}", [&state](const HttpRequest& request) -> HttpReply {
        state.outputs.remove(number_of(request));
        return Json::object();
    });
    http.route("GET", "/api/outputs/{output}/file", [&state](const HttpRequest& request) {
        return send_file(state.outputs.file(number_of(request)));
    });
}

}  // namespace lamella
