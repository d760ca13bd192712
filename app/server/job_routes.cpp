// Jobs: building, facts, checks; and the stream of events.
#include "app/reports/check_outputs.h"
#include "app/server/server_state.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

HttpReply build(ServerState& state, const HttpRequest& request) {
    const Json json = request.json();
    if (!json.contains("text") || !json["text"].is_string())
        throw HttpError(400, "text: missing, or no text");
    const std::string session = json.value("session", std::string());
    std::int64_t sequence = 0;
    if (json.contains("sequence")) {
        if (!json["sequence"].is_number_integer()) throw HttpError(400, "sequence: accepted: a whole number");
        sequence = json["sequence"].get<std::int64_t>();
    }
    const Json searches = json.value("searches", Json(true));
    if (!searches.is_boolean()) throw HttpError(400, "searches: accepted: true, false");
    return state.jobs.build(json["text"].get<std::string>(), session, sequence, searches.get<bool>())
        ->facts();
}

HttpReply check(ServerState& state, const HttpRequest& request) {
    const auto job = state.jobs.find(request.parts.at("job"));
    const ComputeTurn turn(state.turns);
    const std::string session = request.text("session");
    OutputChecks checks;
    const auto backend = checks.check_of(job->recipe.printer, job->recipe.part.name, job->job(), job->parts);
    const SessionWork work(state, request);
    StreamOptions options;
    static_cast<PassControl&>(options) = work.control;
    options.range = {0, job->job().layers.count()};
    int told = 0;
    options.on_progress = [&](const Progress& progress) {
        if (progress.done < told + progress.total / 100) return;
        told = progress.done;
        state.events.send(session, "progress",
                          {{"what", "check"},
                           {"id", nullptr},
                           {"done", progress.done},
                           {"of", progress.total},
                           {"text", "checking"}});
    };
    stream_layers(job->job(), *backend, options);
    HttpReply reply = check_json(checks.outcomes().front(), job->job());
    reply.tag = job->id + "-check";
    return reply;
}

HttpReply events(ServerState& state, const HttpRequest& request) {
    const std::string session = request.text("session");
    const auto listener = state.events.listen(session);
    HttpReply reply("text/event-stream", "");
    const Json hello{{"session", session}, {"version", LAMELLA_VERSION}};
    reply.stream = [&state, listener, hello, begun = false](const HttpSink& sink) mutable {
        if (!begun) {
            begun = true;
            return sink("event: hello\ndata: " + hello.dump() + "\n\n");
        }
        constexpr int patience = 15;  // seconds
        const std::string text = listener->next(patience);
        return !state.http.stopping() && sink(text);
    };
    return reply;
}

}  // namespace

void add_job_routes(ServerState& state) {
    HttpServer& http = state.http;
    http.route("POST", "/api/jobs", [&state](const HttpRequest& request) { return build(state, request); });
    http.route("GET", "/api/jobs/{job}", [&state](const HttpRequest& request) -> HttpReply {
        return state.jobs.find(request.parts.at("job"))->facts();
    });
    http.route("DELETE", "/api/jobs/{job}", [&state](const HttpRequest& request) -> HttpReply {
        state.jobs.forget(request.parts.at("job"));
        return Json::object();
    });
    http.route("DELETE", "/api/sessions/{session}", [&state](const HttpRequest& request) -> HttpReply {
        state.jobs.end_session(request.parts.at("session"));
        return Json::object();
    });
    http.route("GET", "/api/jobs/{job}/check",
               [&state](const HttpRequest& request) { return check(state, request); });
    http.route("GET", "/api/events", [&state](const HttpRequest& request) { return events(state, request); });
}

}  // namespace lamella
