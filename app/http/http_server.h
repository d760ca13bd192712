// HttpServer: routes, access and errors over a library's HTTP server.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.h"

namespace lamella {

/// Thrown by a handler to answer with a status of its own.
class HttpError : public Error {
  public:
    /// `details`: further members of the reply.
    HttpError(int status, const std::string& message, nlohmann::ordered_json details = {})
        : Error(message), status_(status), details_(std::move(details)) {}
    int status() const { return status_; }
    const nlohmann::ordered_json& details() const { return details_; }

  private:
    int status_;
    nlohmann::ordered_json details_;
};

struct HttpRequest {
    std::map<std::string, std::string> parts;  ///< of the path, by the names of the route's pattern
    std::map<std::string, std::string> query;
    std::string target;  ///< path and query without token and session, for entity tags
    std::string body;
    std::string known_tag;  ///< If-None-Match; empty: none

    /// Parses the body, which has to be an object. Throws HttpError 400.
    nlohmann::ordered_json json() const;
    /// Returns the whole number that a part of the path is. Throws HttpError 404 for anything else.
    int number_part(const std::string& name) const;
    /// Returns a number of the query, or `usual` without one. Throws HttpError 400 for anything but a number
    /// from `least` to `most`.
    double number(const std::string& name, double usual, double least, double most) const;
    int integer(const std::string& name, int usual, int least, int most) const;
    /// Returns a text of the query, or `usual` without one.
    std::string text(const std::string& name, const std::string& usual = "") const;
};

/// Returns a text of a JSON object; empty where it is missing or null. Throws HttpError 400 for another type.
std::string text_member(const nlohmann::ordered_json& json, const char* name);

/// Writes a piece of a reply; returns false once the client is gone.
using HttpSink = std::function<bool(const std::string& piece)>;

/// With its charset the library does not take it for a type to compress, by Brotli's slowest level: the
/// page's script took 1.4 s, and comes over the loopback device.
inline const std::string json_type = "application/json; charset=utf-8";

struct HttpReply {
    HttpReply() = default;
    HttpReply(const nlohmann::ordered_json& json, int code = 200);  // NOLINT(google-explicit-constructor)
    HttpReply(std::string type, std::string bytes) : content_type(std::move(type)), body(std::move(bytes)) {}

    int status = 200;
    std::string content_type = json_type;
    std::string body;
    std::string tag;        ///< of content that never changes, for ETag; empty: not to be kept
    std::string file_name;  ///< of a download; empty: none
    /// Sends the body in pieces until it returns false; empty: `body` is all.
    std::function<bool(const HttpSink& sink)> stream;
    std::optional<std::size_t> length;  ///< of all pieces, where it is known
};

using HttpHandler = std::function<HttpReply(const HttpRequest& request)>;

struct HttpOptions {
    std::string address = "127.0.0.1";
    int port = 0;                          ///< 0: any that is free
    std::string token;                     ///< asked for below /api/
    int threads = 16;                      ///< requests that are answered at once
    std::size_t largest_body = 64U << 20;  ///< bytes
};

/// Serves routes until it is stopped. Handlers run in several threads at once. A request below /api/ needs
/// the token, as `Authorization: Bearer TOKEN` or `token=TOKEN` in the query. Requests of pages from
/// elsewhere (by Origin), and those that reach the server by a name that is not its own (by Host), are
/// refused.
///
/// Errors are answered as {"message": ...}: InputError and malformed requests by 400, Interrupted by 409, all
/// other exceptions by 500.
class HttpServer {
  public:
    explicit HttpServer(HttpOptions options);
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    /// Adds a route, such as "GET", "/api/jobs/{job}". Call before serving.
    void route(const std::string& method, const std::string& pattern, HttpHandler handler);
    /// Returns all routes as "GET /api/jobs/{job}".
    std::vector<std::string> routes() const;

    /// Returns the port that the server is bound to. Throws FaultError from the constructor where it cannot
    /// be.
    int port() const;
    const HttpOptions& options() const;
    /// Serves until stop() is called from another thread.
    void serve();
    /// Safe to call from any thread; streams end within a second.
    void stop();
    bool stopping() const;

  private:
    struct Route;
    struct State;
    std::unique_ptr<State> state_;
};

/// Returns a random token of 32 hexadecimal digits.
std::string random_token();

}  // namespace lamella
