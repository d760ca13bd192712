// Jobs sent to a printer on the network by HTTP; the printer is a Moonraker of a few routes.
#include <cstdlib>
#include <fstream>
#include <mutex>

#include "tests/app/commands/mentions.h"
#include "tests/app/server/running_server.h"
#include "tests/wait_for.h"

namespace host_routes_test {

using namespace lamella;
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

const std::string ball =
    "[part]\nshape = \"sphere\"\nradius = 2.5\n[layers]\nheight = 0.25\n[printer]\nprofile = \"marlin\"\n";

/// A host that keeps one file and one state.
class SmallMoonraker {
  public:
    SmallMoonraker() {
        const auto answer = [](httplib::Response& response, const Json& result) {
            response.set_content(Json{{"result", result}}.dump(), "application/json");
        };
        server_.Get("/server/info", [=](const httplib::Request&, httplib::Response& response) {
            answer(response, {{"klippy_state", "ready"}, {"moonraker_version", "v0.9"}});
        });
        server_.Get("/printer/info", [=](const httplib::Request&, httplib::Response& response) {
            answer(response, {{"hostname", "small"}});
        });
        server_.Get("/server/files/directory", [=](const httplib::Request&, httplib::Response& response) {
            answer(response, {{"disk_usage", {{"free", 1000000000}}}});
        });
        server_.Get("/server/files/metadata",
                    [this, answer](const httplib::Request& request, httplib::Response& response) {
                        const std::lock_guard lock(mutex_);
                        if (request.get_param_value("filename") == name_)
                            answer(response, {{"size", content_.size()}});
                        else
                            response.status = 404;
                    });
        server_.Get("/printer/objects/query",
                    [this, answer](const httplib::Request&, httplib::Response& response) {
                        const std::lock_guard lock(mutex_);
                        answer(response, {{"status",
                                           {{"print_stats", {{"state", state_}, {"filename", printed_}}},
                                            {"extruder", {{"temperature", 214.5}, {"target", 215}}}}}});
                    });
        server_.Post("/server/files/upload",
                     [this](const httplib::Request& request, httplib::Response& response) {
                         const std::lock_guard lock(mutex_);
                         name_ = request.get_file_value("file").filename;
                         content_ = request.get_file_value("file").content;
                         response.status = 201;
                         response.set_content("{}", "application/json");
                     });
        for (const auto& [what, state] : {std::pair("start", "printing"),
                                          {"pause", "paused"},
                                          {"resume", "printing"},
                                          {"cancel", "cancelled"}}) {
            server_.Post(std::string("/printer/print/") + what,
                         [this, answer, next = std::string(state)](const httplib::Request& request,
                                                                   httplib::Response& response) {
                             const std::lock_guard lock(mutex_);
                             if (request.has_param("filename"))
                                 printed_ = request.get_param_value("filename"), ++starts_;
                             state_ = next;
                             answer(response, "ok");
                         });
        }
        port_ = server_.bind_to_any_port("127.0.0.1");
        thread_ = std::thread([this] { server_.listen_after_bind(); });
    }
    ~SmallMoonraker() {
        server_.stop();
        thread_.join();
    }
    SmallMoonraker(const SmallMoonraker&) = delete;
    SmallMoonraker& operator=(const SmallMoonraker&) = delete;

    std::string url() const { return "http://127.0.0.1:" + std::to_string(port_); }
    std::string content() const {
        const std::lock_guard lock(mutex_);
        return content_;
    }
    int starts() const {
        const std::lock_guard lock(mutex_);
        return starts_;
    }

  private:
    httplib::Server server_;
    mutable std::mutex mutex_;
    std::string name_, content_, state_ = "standby", printed_;
    int starts_ = 0;
    int port_ = 0;
    std::thread thread_;
};

/// A folder of settings with a file of hosts; the one before comes back in the end.
class HostsFile {
  public:
    explicit HostsFile(const std::string& text) {
        fs::create_directories(folder_ / "lamella");
        const fs::path file = folder_ / "lamella/hosts.toml";
        std::ofstream(file) << text;
        fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
        setenv("XDG_CONFIG_HOME", folder_.path().c_str(), 1);
    }
    ~HostsFile() {
        if (before_.empty())
            unsetenv("XDG_CONFIG_HOME");
        else
            setenv("XDG_CONFIG_HOME", before_.c_str(), 1);
    }
    HostsFile(const HostsFile&) = delete;
    HostsFile& operator=(const HostsFile&) = delete;

  private:
    static std::string config() {
        const char* text = std::getenv("XDG_CONFIG_HOME");
        return text != nullptr ? text : "";
    }
    Folder folder_;
    std::string before_ = config();
};

Json sent(const RunningServer& server) {
    REQUIRE(wait_for(60, [&] { return server.json("GET", "/api/sending")["state"] != "running"; }));
    return server.json("GET", "/api/sending");
}

}  // namespace

TEST_CASE("a job is sent to a host, printed there once, and its bytes are those of its file",
          "[server][hosts]") {
    SmallMoonraker host;
    const HostsFile file("[small]\nkind = \"moonraker\"\nurl = \"" + host.url() +
                         "\"\nkey = \"very-secret\"\n");
    const RunningServer server;
    const std::string list = server.send("GET", "/api/hosts")->body;
    CHECK(mentions(list, "\"small\""));
    CHECK(!mentions(list, "very-secret"));
    const Json facts = server.json("GET", "/api/hosts/small");
    CHECK(facts["machine"] == "small");
    CHECK(facts["free_bytes"] == 1000000000);
    CHECK(facts["status"]["state"] == "idle");

    const std::string job = server.build(ball);
    const int output = server.json("POST", "/api/jobs/" + job + "/outputs", Json::object(), 202)["output"];
    const std::string address = "/api/outputs/" + std::to_string(output);
    REQUIRE(wait_for(60, [&] { return server.json("GET", address)["state"] == "done"; }));
    server.json("POST", "/api/jobs/" + job + "/send", {{"host", "small"}, {"start", true}}, 202);
    const Json report = sent(server);
    CHECK(report["state"] == "done");
    CHECK(report["prints"] == true);
    CHECK(report["message"] == "");
    CHECK(host.content() == server.send("GET", address + "/file")->body);
    CHECK(host.starts() == 1);

    server.json("POST", "/api/jobs/" + job + "/send", {{"host", "small"}, {"start", true}}, 202);
    CHECK(sent(server)["prints"] == true);
    CHECK(host.starts() == 1);
    CHECK(server.json("POST", "/api/hosts/small/pause")["state"] == "paused");
    CHECK(server.json("POST", "/api/hosts/small/resume")["state"] == "printing");
    CHECK(server.json("POST", "/api/hosts/small/cancel")["state"] == "cancelled");
}

TEST_CASE("only hosts of the user's file are spoken to, and their faults are told", "[server][hosts]") {
    const HostsFile file("[gone]\nkind = \"moonraker\"\nurl = \"http://127.0.0.1:1\"\n");
    const RunningServer server;
    const std::string job = server.build(ball);
    const auto refused = [&](const Json& body, int status, const std::string& words) {
        const Json reply = server.json("POST", "/api/jobs/" + job + "/send", body, status);
        CHECK(mentions(reply["message"].get<std::string>(), words));
    };
    refused({{"host", "moonraker+http://127.0.0.1:1"}}, 400, "accepted: a name in ");
    refused({{"host", "other"}}, 400, "accepted: a name in ");
    refused({{"host", "gone"}, {"print", true}}, 400, "unknown; accepted: host, start, again");
    refused({{"host", "gone"}, {"start", 1}}, 400, "accepted: true or false");
    CHECK(mentions(server.json("GET", "/api/hosts/gone", {}, 502)["message"].get<std::string>(),
                   "cannot be reached"));
    server.json("GET", "/api/hosts/other", {}, 404);
    CHECK(server.json("GET", "/api/sending")["state"] == "none");
    server.json("POST", "/api/jobs/" + job + "/send", {{"host", "gone"}}, 202);
    server.json("DELETE", "/api/sending");
    CHECK(sent(server)["state"] == "cancelled");
}

}  // namespace host_routes_test
