// The description of the interface against the server: the same routes, and replies of the described form.
#include <algorithm>
#include <set>

#include "tests/app/server/described_form.h"
#include "tests/app/server/running_server.h"

namespace openapi_test {

using namespace lamella;

namespace {

using Json = nlohmann::ordered_json;

std::string upper(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

}  // namespace

TEST_CASE("the description has every route, and no other", "[server]") {
    RunningServer server;
    const Json document = server.json("GET", "/api/openapi.json");
    std::set<std::string> described, served;
    for (const auto& [path, methods] : document["paths"].items())
        for (const auto& [method, operation] : methods.items()) described.insert(upper(method) + " " + path);
    for (const std::string& route : server.state().http.routes()) served.insert(route);
    CHECK(described == served);
}

TEST_CASE("replies have the form that the description gives them", "[server]") {
    const RunningServer server;
    const Json document = server.json("GET", "/api/openapi.json");
    const std::string recipe =
        "[part]\nshape = \"sphere\"\nradius = 3\n[layers]\nheight = 0.2\n[printer]\nprofile = \"marlin\"\n";
    const std::string job = server.build(recipe);
    const int output = server.json("POST", "/api/jobs/" + job + "/outputs", {}, 202)["output"];
    const std::string foam = server.build(recipe + "[foam]\ncell = 4\nbeam = 0.6\n");
    const int analysis =
        server.json("POST", "/api/jobs/" + foam + "/homogenize", {{"rve", 32}}, 202)["analysis"];
    const auto filled = [&](std::string path) {
        for (const auto& [part, value] : {std::pair<std::string, std::string>{"{job}", job},
                                          {"{layer}", "5"},
                                          {"{session}", "test"},
                                          {"{output}", std::to_string(output)},
                                          {"{analysis}", std::to_string(analysis)}}) {
            if (const std::size_t at = path.find(part); at != std::string::npos)
                path.replace(at, part.size(), value);
        }
        return path;
    };
    const auto check = [&](const std::string& method, const std::string& path, const Json& body) {
        const Json& responses = document["paths"].at(path).at(method)["responses"];
        const auto reply = server.send(upper(method), filled(path), body.is_null() ? "" : body.dump());
        INFO(method << " " << path << " " << reply->status << " " << reply->body.substr(0, 200));
        const std::string status = std::to_string(reply->status);
        REQUIRE(responses.contains(status));
        const Json& contents = responses[status]["content"];
        const std::string type = contents.begin().key();
        const Json& content = contents.begin().value();
        const std::string given = reply->get_header_value("Content-Type");
        CHECK(given.substr(0, given.find(';')) == type);  // without parameters
        if (type == "application/json")
            CHECK(misfit(document, content["schema"], Json::parse(reply->body), path).empty());
    };
    for (const auto& [path, methods] : document["paths"].items()) {
        if (path == "/api/events" || path.ends_with("/file") || !methods.contains("get")) continue;
        check("get", path, nullptr);
    }
    check("post", "/api/jobs", {{"text", recipe}});
    check("post", "/api/jobs", {{"text", "[part]\n"}});
    check("post", "/api/jobs", {{"text", 1}});
    check("post", "/api/values", {{"text", recipe}});
    check("post", "/api/edit", {{"text", recipe}, {"changes", Json::array()}});
    check("put", "/api/recipe", {{"text", recipe}, {"path", "a.toml"}});
    check("get", "/api/outputs/{output}", nullptr);
    check("delete", "/api/outputs/{output}", nullptr);
    check("get", "/api/outputs/{output}", nullptr);
    check("post", "/api/jobs/{job}/print", Json::object());
    check("post", "/api/jobs/{job}/print", {{"to", {{"serial", "/dev/none"}}}});
    check("post", "/api/jobs/{job}/homogenize", {{"rve", 32}});
    check("post", "/api/optimize", {{"text", recipe}});
    check("post", "/api/optimize", {{"text", "[part]\n"}});
    check("post", "/api/analyses/{analysis}/stop", nullptr);
    check("delete", "/api/analyses/{analysis}", nullptr);
    check("get", "/api/analyses/{analysis}", nullptr);
    check("delete", "/api/sessions/{session}", nullptr);
    check("delete", "/api/jobs/{job}", nullptr);
    check("get", "/api/jobs/{job}/layers/{layer}/contours", nullptr);
    for (const char* order : {"pause", "resume", "stop", "halt"})
        check("post", std::string("/api/print/") + order, nullptr);
    check("post", "/api/print/choose", {{"button", 0}});
    check("post", "/api/print/choose", {{"button", "first"}});
}

}  // namespace openapi_test
