// The server as HTTP: who may ask, what is refused, what may be kept, and replies that come whole.
#include <chrono>
#include <string>
#include <thread>

#include "tests/app/commands/command_run.h"
#include "tests/app/commands/mentions.h"
#include "tests/app/server/running_server.h"

namespace http_test {

using namespace lamella;

namespace {

using Json = nlohmann::ordered_json;

const std::string ball =
    "[part]\nshape = \"sphere\"\nradius = 5\n[layers]\nheight = 0.1\n[printer]\nprofile = \"prusa-sl1s\"\n";

int status_of(const httplib::Result& result) { return result ? result->status : 0; }

}  // namespace

TEST_CASE("only who has the token and comes from this machine's page is answered", "[server]") {
    const RunningServer server;
    httplib::Client client = server.client();
    CHECK(status_of(client.Get("/api/version")) == 401);
    CHECK(status_of(client.Get("/api/version?token=0123456789abcdee")) == 401);
    CHECK(status_of(client.Get(("/api/version?token=" + test_token).c_str())) == 200);
    CHECK(status_of(client.Post("/api/jobs", "{}", "application/json")) == 401);
    CHECK(server.send("GET", "/api/version", "", {{"Origin", "http://example.com"}})->status == 403);
    const std::string own = "127.0.0.1:" + std::to_string(server.port());
    CHECK(server.send("GET", "/api/version", "", {{"Origin", "http://" + own}})->status == 200);
    CHECK(server.send("GET", "/api/version", "", {{"Host", "example.com"}})->status == 403);
    CHECK(server.send("GET", "/api/version", "", {{"Host", "localhost:1"}})->status == 200);
    const auto reply = server.send("GET", "/api/version");
    CHECK(mentions(reply->get_header_value("Content-Security-Policy"), "default-src 'self'"));
    CHECK(!mentions(reply->get_header_value("Content-Security-Policy"), "unsafe"));
}

TEST_CASE("what is no request of the interface gets one clear message", "[server]") {
    const RunningServer server;
    const auto message = [&](const std::string& method, const std::string& path, const std::string& body,
                             int status) {
        const auto reply = server.send(method, path, body);
        INFO(method << " " << path << " " << body.substr(0, 60));
        CHECK(reply->status == status);
        const Json json = Json::parse(reply->body);
        CHECK(!json["message"].get<std::string>().empty());
        return json["message"].get<std::string>();
    };
    message("GET", "/api/nothing", "", 404);
    message("GET", "/etc/passwd", "", 404);
    message("GET", "/../../etc/passwd", "", 404);
    message("GET", "/" + std::string(7000, 'a'), "", 404);
    message("DELETE", "/api/version", "", 405);
    message("POST", "/api/jobs", "", 400);
    message("POST", "/api/jobs", "[]", 400);
    message("POST", "/api/jobs", "{\"text\": 3}", 400);
    message("POST", "/api/jobs", std::string(100000, '['), 400);
    message("POST", "/api/jobs", "{\"text\": \"\", \"sequence\": \"one\"}", 400);
    message("POST", "/api/jobs", "{\"text\": \"" + std::string(9U << 20, ' ') + "\"}", 413);
    message("GET", "/api/jobs/none", "", 404);
    message("GET", "/api/outputs/7", "", 404);
    message("GET", "/api/outputs/seven", "", 404);
    const std::string job = server.build(ball);
    for (const char* layer : {"-1", "100", "x", "1e1", ""})
        message("GET", "/api/jobs/" + job + "/layers/" + layer + "/mask.png", "", 404);
    const std::string mask = "/api/jobs/" + job + "/layers/3/mask.png";
    CHECK(mentions(message("GET", mask + "?width=9000", "", 400), "width: \"9000\" is not accepted"));
    message("GET", mask + "?width=8192&x0=0&x1=0.001&y0=-5&y1=5", "", 400);
    message("GET", mask + "?x0=5&x1=-5", "", 400);
    message("GET", mask + "?x0=nan", "", 400);
    message("GET", "/api/jobs/" + job + "/layers/3/runs?columns=0", "", 400);
    message("GET", "/api/jobs/" + job + "/layers/3/contours?what=all", "", 400);
    message("GET", "/api/jobs/" + job + "/volume?n=5000", "", 400);
    CHECK(mentions(message("GET", "/api/jobs/" + job + "/layers/3/paths", "", 400), "lays no beads"));
}

TEST_CASE("replies about layers may be kept for ever", "[server]") {
    const RunningServer server;
    const std::string path = "/api/jobs/" + server.build(ball) + "/layers/30/mask.png";
    const auto first = server.send("GET", path);
    CHECK(mentions(first->get_header_value("Cache-Control"), "immutable"));
    const std::string tag = first->get_header_value("ETag");
    REQUIRE(tag.size() > 20);
    const auto again = server.send("GET", path, "", {{"If-None-Match", tag}});
    CHECK(again->status == 304);
    CHECK(again->body.empty());
    CHECK(server.send("GET", path + "?width=50", "", {{"If-None-Match", tag}})->status == 200);
    CHECK(server.send("GET", path)->body == first->body);
    CHECK(server.send("GET", "/api/version")->get_header_value("Cache-Control") == "no-store");
}

TEST_CASE("replies come whole, also to who asks for a range of bytes", "[server]") {
    const RunningServer server;
    write(server.folder() / "ball.toml", ball);
    const std::string job = "/api/jobs/" + server.build(ball);
    const int output = server.json("POST", job + "/outputs", {}, 202)["output"];
    const std::string file = "/api/outputs/" + std::to_string(output) + "/file";
    while (server.send("GET", file)->status != 200)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    for (const std::string& path : {job + "/layers/30/mask.png", file}) {
        const auto whole = server.send("GET", path);
        // A browser that gave up a reply asks for its rest, beginning with one byte.
        for (const char* range : {"bytes=7-7", "bytes=7-", "bytes=-7", "bytes=0-3,7-9"}) {
            INFO(path << " " << range);
            const auto reply = server.send("GET", path, "", {{"Range", range}});
            CHECK(reply->status == 200);
            CHECK(reply->body == whole->body);
            CHECK(!reply->has_header("Content-Range"));
        }
    }
}

}  // namespace http_test
