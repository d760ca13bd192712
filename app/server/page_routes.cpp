// The files of the studio's page.
#include "app/server/embedded_files.h"
#include "app/server/server_state.h"

namespace lamella {

namespace {

std::string type_of(std::string_view name) {
    if (name.ends_with(".html")) return "text/html; charset=utf-8";
    if (name.ends_with(".js")) return "application/javascript; charset=utf-8";  // see json_type
    if (name.ends_with(".css")) return "text/css; charset=utf-8";
    if (name.ends_with(".svg")) return "image/svg+xml";
    return "application/octet-stream";
}

}  // namespace

void add_page_routes(ServerState& state) {
    for (const EmbeddedFile& file : page_files()) {
        const auto send = [file](const HttpRequest&) {
            return HttpReply(type_of(file.name), std::string(file.text));
        };
        if (file.name == "index.html") state.http.route("GET", "/", send);
        state.http.route("GET", "/" + std::string(file.name), send);
    }
}

}  // namespace lamella
