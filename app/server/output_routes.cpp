// Outputs: files that are sliced in the background.
#include <fstream>

#include "app/server/server_state.h"
#include "engine/base/whole_file.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

HttpReply start(ServerState& state, const HttpRequest& request) {
    const auto job = state.jobs.find(request.parts.at("job"));
    const Json json = request.body.empty() ? Json::object() : request.json();
    const int number = state.outputs.start(job, text_member(json, "file"), text_member(json, "session"));
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
        return state.outputs.describe(request.number_part("output"));
    });
    http.route("DELETE", "/api/outputs/{output}", [&state](const HttpRequest& request) -> HttpReply {
        state.outputs.remove(request.number_part("output"));
        return Json::object();
    });
    http.route("GET", "/api/outputs/{output}/file", [&state](const HttpRequest& request) {
        return send_file(state.outputs.file(request.number_part("output")));
    });
}

}  // namespace lamella
