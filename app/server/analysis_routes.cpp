// Analyses: homogenisations and searches that are computed in the background.
#include "app/jobs/analysis_work.h"
#include "app/server/server_state.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

int whole_in(const Json& json, const char* name, int usual, int least, int most) {
    if (!json.contains(name) || json[name].is_null()) return usual;
    const bool fits = json[name].is_number_integer() && json[name].get<double>() >= least &&
                      json[name].get<double>() <= most;
    if (!fits) {
        throw HttpError(400, std::string(name) + ": accepted: a whole number from " + std::to_string(least) +
                                 " to " + std::to_string(most));
    }
    return json[name].get<int>();
}

bool flag_in(const Json& json, const char* name) {
    if (!json.contains(name)) return false;
    if (!json[name].is_boolean()) throw HttpError(400, std::string(name) + ": accepted: true, false");
    return json[name].get<bool>();
}

HttpReply accepted(ServerState& state, int number) { return {state.analyses.find(number)->describe(), 202}; }

HttpReply homogenize(ServerState& state, const HttpRequest& request) {
    constexpr int most_elements = 256,
                  most_samples = 16;  // what an ordinary machine's memory and patience bear
    auto job = state.jobs.find(request.parts.at("job"));
    const Json json = request.body.empty() ? Json::object() : request.json();
    StiffnessOptions options;
    options.elements = whole_in(json, "rve", 0, 0, most_elements);
    options.samples = whole_in(json, "samples", 1, 1, most_samples);
    options.threads = state.options.threads;
    return accepted(state, state.analyses.start("homogenize", text_member(json, "session"),
                                                homogenize_work(std::move(job), options)));
}

HttpReply optimize(ServerState& state, const HttpRequest& request) {
    const Json json = request.json();
    if (!json.contains("text")) throw HttpError(400, "text: missing");
    return accepted(state,
                    state.analyses.start("optimize", text_member(json, "session"),
                                         optimize_work(text_member(json, "text"), state.folder,
                                                       flag_in(json, "resume"), state.options.threads)));
}

}  // namespace

void add_analysis_routes(ServerState& state) {
    HttpServer& http = state.http;
    http.route("POST", "/api/jobs/{job}/homogenize",
               [&state](const HttpRequest& request) { return homogenize(state, request); });
    http.route("POST", "/api/optimize",
               [&state](const HttpRequest& request) { return optimize(state, request); });
    const std::string one = "/api/analyses/{analysis}";
    http.route("GET", one, [&state](const HttpRequest& request) -> HttpReply {
        return state.analyses.find(request.number_part("analysis"))->describe();
    });
    http.route("DELETE", one, [&state](const HttpRequest& request) -> HttpReply {
        state.analyses.remove(request.number_part("analysis"));
        return Json::object();
    });
    http.route("POST", one + "/stop", [&state](const HttpRequest& request) -> HttpReply {
        return state.analyses.stop(request.number_part("analysis"))->describe();
    });
    http.route("GET", one + "/volume", [&state](const HttpRequest& request) -> HttpReply {
        return {"application/octet-stream", state.analyses.find(request.number_part("analysis"))->design()};
    });
}

}  // namespace lamella
