// A server on a port of its own, and requests to it.
#pragma once

#include <httplib.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/server/server_state.h"
#include "tests/app/commands/folder.h"

namespace lamella {

inline const std::string test_token = "0123456789abcdef";

/// Serves a temporary folder until it goes.
class RunningServer {
  public:
    using Json = nlohmann::ordered_json;

    explicit RunningServer(ServerOptions options = {})
        : state_([&] {
              options.folder = folder_.path();
              options.http.token = test_token;
              return options;
          }()) {
        thread_ = std::thread([this] { state_.http.serve(); });
        while (!client().Get("/api/version")) std::this_thread::yield();
    }
    ~RunningServer() {
        state_.jobs.cancel_all();
        state_.events.end();
        state_.http.stop();
        thread_.join();
    }
    RunningServer(const RunningServer&) = delete;
    RunningServer& operator=(const RunningServer&) = delete;

    const Folder& folder() const { return folder_; }
    ServerState& state() { return state_; }
    int port() const { return state_.http.port(); }
    /// A client that sends no token.
    httplib::Client client() const {
        httplib::Client client("127.0.0.1", port());
        client.set_read_timeout(60);
        return client;
    }
    /// Sends a request with the token. Asserts nothing, so any thread may call it.
    httplib::Result ask(const std::string& method, const std::string& path, const std::string& body = "",
                        httplib::Headers headers = {}) const {
        headers.emplace("Authorization", "Bearer " + test_token);
        httplib::Request request;
        request.method = method;
        request.path = path;
        request.headers = std::move(headers);
        request.body = body;
        httplib::Client asking = client();
        return asking.send(request);
    }
    /// The status of the reply; 0 if there is none. Asserts nothing.
    int status(const std::string& method, const std::string& path, const std::string& body = "") const {
        const auto reply = ask(method, path, body);
        return reply ? reply->status : 0;
    }
    /// The same as ask(); there has to be a reply.
    httplib::Result send(const std::string& method, const std::string& path, const std::string& body = "",
                         httplib::Headers headers = {}) const {
        auto result = ask(method, path, body, std::move(headers));
        REQUIRE(result);
        return result;
    }
    /// The JSON of a reply with this status.
    Json json(const std::string& method, const std::string& path, const Json& body = {},
              int status = 200) const {
        const auto reply = send(method, path, body.is_null() ? "" : body.dump());
        INFO(method << " " << path << ": " << reply->body.substr(0, 300));
        CHECK(reply->status == status);
        return Json::parse(reply->body);
    }
    std::string build(const std::string& recipe) const {
        return json("POST", "/api/jobs", {{"text", recipe}, {"session", "test"}, {"sequence", next_++}})
            .at("job")
            .get<std::string>();
    }

  private:
    Folder folder_;
    ServerState state_;
    std::thread thread_;
    mutable int next_ = 1;
};

}  // namespace lamella
