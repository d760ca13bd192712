// Matches routes, checks access, and turns exceptions into replies.
#include "app/http/http_server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <fstream>
#include <vector>

#include "engine/base/json_depth.h"

namespace lamella {

namespace {

constexpr std::size_t largest_json = 8U << 20;

/// Splits a path at its slashes.
std::vector<std::string> parts_of(const std::string& path) {
    std::vector<std::string> parts;
    for (std::size_t at = 1; at <= path.size();) {
        const std::size_t end = std::min(path.find('/', at), path.size());
        parts.push_back(path.substr(at, end - at));
        at = end + 1;
    }
    return parts;
}

/// Compares in a time that does not depend on where the texts differ.
bool equal_secrets(const std::string& a, const std::string& b) {
    unsigned difference = a.size() == b.size() ? 0 : 1;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        difference |=
            static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
    return difference == 0;
}

std::string without_port(const std::string& host) {
    const std::size_t colon = host.rfind(':');
    return colon == std::string::npos || host.ends_with(']') ? host : host.substr(0, colon);
}

/// Whether a Host header names this machine: a page elsewhere may have a name that leads here.
bool is_own_host(const std::string& host, const std::string& address) {
    const std::string name = without_port(host);
    if (name == "localhost" || name == "127.0.0.1" || name == "[::1]" || name == address) return true;
    // Listening to other machines: they use this one's numbers or name.
    return address == "0.0.0.0" || address == "::";
}

void answer(httplib::Response& response, int status, const std::string& message,
            const nlohmann::ordered_json& details = {}) {
    nlohmann::ordered_json json{{"message", message}};
    if (details.is_object()) json.update(details);
    response.status = status;
    response.set_content(HttpReply(json).body, json_type.c_str());
}

}  // namespace

nlohmann::ordered_json HttpRequest::json() const {
    if (body.size() > largest_json)
        throw HttpError(413, fmt::format("the request has more than {} bytes", largest_json));
    try {
        auto parsed = nlohmann::ordered_json::parse(shallow_json(body));
        if (parsed.is_object()) return parsed;
    } catch (const nlohmann::json::exception&) {  // answered below
    }
    throw HttpError(400, "the body is no JSON object");
}

std::string text_member(const nlohmann::ordered_json& json, const char* name) {
    if (!json.contains(name) || json[name].is_null()) return {};
    if (!json[name].is_string()) throw HttpError(400, std::string(name) + ": accepted: a text");
    return json[name].get<std::string>();
}

int HttpRequest::number_part(const std::string& name) const {
    const std::string& part = parts.at(name);
    int number = 0;
    const auto parsed = std::from_chars(part.data(), part.data() + part.size(), number);
    if (parsed.ec != std::errc{} || parsed.ptr != part.data() + part.size())
        throw HttpError(404, "there is no such " + name);
    return number;
}

double HttpRequest::number(const std::string& name, double usual, double least, double most) const {
    const auto found = query.find(name);
    if (found == query.end()) return usual;
    double value = 0;
    const char* end = found->second.data() + found->second.size();
    const auto parsed = std::from_chars(found->second.data(), end, value);
    if (parsed.ec != std::errc{} || parsed.ptr != end || !(value >= least && value <= most)) {
        throw HttpError(400, fmt::format("{}: \"{}\" is not accepted; accepted: a number from {} to {}", name,
                                         found->second.substr(0, 32), least, most));
    }
    return value;
}

int HttpRequest::integer(const std::string& name, int usual, int least, int most) const {
    const double value = number(name, usual, least, most);
    if (value != std::floor(value)) throw HttpError(400, name + ": accepted: a whole number");
    return static_cast<int>(value);
}

std::string HttpRequest::text(const std::string& name, const std::string& usual) const {
    const auto found = query.find(name);
    return found == query.end() ? usual : found->second;
}

HttpReply::HttpReply(const nlohmann::ordered_json& json, int code)
    : status(code), body(json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) {}

/// A route and its handler.
struct HttpServer::Route {
    std::string method, pattern;
    std::vector<std::string> parts;
    HttpHandler handler;

    /// Whether a path is one of this route; fills in its named parts.
    bool matches(const std::vector<std::string>& path, std::map<std::string, std::string>& named) const {
        if (path.size() != parts.size()) return false;
        named.clear();
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (parts[i].starts_with('{')) {
                named[parts[i].substr(1, parts[i].size() - 2)] = path[i];
            } else if (parts[i] != path[i]) {
                return false;
            }
        }
        return true;
    }
};

struct HttpServer::State {
    HttpOptions options;
    httplib::Server server;
    std::vector<Route> routes;
    std::atomic<bool> stops{false};
    int port = 0;

    bool may_pass(const httplib::Request& request, httplib::Response& response) const {
        const std::string host = request.get_header_value("Host");
        if (!is_own_host(host, options.address)) {
            answer(response, 403, "the server is not known by the name of this request's Host");
            return false;
        }
        const std::string origin = request.get_header_value("Origin");
        if (!origin.empty() && origin != "http://" + host) {
            answer(response, 403, "requests of other pages are refused");
            return false;
        }
        if (!request.path.starts_with("/api/")) return true;
        const std::string bearer = request.get_header_value("Authorization");
        const std::string given =
            bearer.starts_with("Bearer ") ? bearer.substr(7) : request.get_param_value("token");
        if (equal_secrets(given, options.token)) return true;
        answer(response, 401,
               "the token is missing or wrong; accepted: that of the address the server printed");
        return false;
    }

    void send(const HttpReply& reply, const HttpRequest& request, httplib::Response& response) {
        response.status = reply.status;
        if (!reply.file_name.empty())
            response.set_header("Content-Disposition",
                                fmt::format("attachment; filename=\"{}\"", reply.file_name));
        response.set_header("Cache-Control",
                            reply.tag.empty() ? "no-store" : "private, max-age=31536000, immutable");
        if (!reply.tag.empty()) {
            const std::string tag = "\"" + reply.tag + "\"";
            response.set_header("ETag", tag);
            if (request.known_tag == tag) {
                response.status = 304;
                return;
            }
        }
        if (!reply.stream) {
            response.set_content(reply.body, reply.content_type.c_str());
            return;
        }
        // A reply that cannot be sent to its end must not look whole: the connection is then cut.
        const auto send_piece = [this, stream = reply.stream,
                                 counts = reply.length.has_value()](httplib::DataSink& sink) {
            bool is_cut = false;
            const HttpSink write = [&](const std::string& piece) {
                is_cut = !sink.write(piece.data(), piece.size());
                return !is_cut;
            };
            const bool has_ended = stops || !stream(write);
            if (has_ended && counts) return false;  // before its length: the library ends it there
            if (has_ended) sink.done();
            return !is_cut;
        };
        if (reply.length) {
            response.set_content_provider(
                *reply.length, reply.content_type.c_str(),
                [send_piece](std::size_t, std::size_t, httplib::DataSink& sink) { return send_piece(sink); });
        } else {
            response.set_chunked_content_provider(
                reply.content_type.c_str(),
                [send_piece](std::size_t, httplib::DataSink& sink) { return send_piece(sink); });
        }
    }

    void dispatch(const httplib::Request& given, httplib::Response& response) {
        HttpRequest request;
        bool is_known_path = false;
        const std::vector<std::string> path = parts_of(given.path);
        for (const Route& route : routes) {
            if (!route.matches(path, request.parts)) continue;
            is_known_path = true;
            if (route.method != given.method && !(given.method == "HEAD" && route.method == "GET")) continue;
            request.body = given.body;
            request.known_tag = given.get_header_value("If-None-Match");
            request.target = given.path;
            for (const auto& [name, value] : given.params) {
                if (name == "token") continue;
                request.query[name] = value;
            }
            for (const auto& [name, value] : request.query)
                if (name != "session") request.target.append("&").append(name).append("=").append(value);
            send(route.handler(request), request, response);
            return;
        }
        if (is_known_path) throw HttpError(405, given.method + " is not accepted here");
        throw HttpError(404, "there is nothing at this address");
    }

    void handle(const httplib::Request& request, httplib::Response& response) {
        try {
            dispatch(request, response);
        } catch (const HttpError& error) {
            answer(response, error.status(), error.what(), error.details());
        } catch (const InputError& error) {
            answer(response, 400, error.what());
        } catch (const Interrupted& error) {
            answer(response, 409, error.what());
        } catch (const std::bad_alloc&) {
            answer(response, 503, "memory is short");
        } catch (const std::exception& error) {
            answer(response, 500, error.what());
        }
    }

    void set_up() {
        server.new_task_queue = [this] {
            return new httplib::ThreadPool(static_cast<std::size_t>(options.threads));
        };
        server.set_payload_max_length(options.largest_body);
        server.set_tcp_nodelay(true);
        server.set_default_headers(
            {{"X-Content-Type-Options", "nosniff"},
             {"Referrer-Policy", "no-referrer"},
             {"Cross-Origin-Resource-Policy", "same-origin"},
             {"Content-Security-Policy",
              "default-src 'self'; img-src 'self' blob: data:; frame-ancestors 'none'; base-uri 'none'; "
              "form-action 'none'"}});
        server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
            // The library would cut a reply to the range asked for, and leave its status and its stream as
            // they are. A browser that resumes takes the piece for the whole. A server may ignore ranges (RFC
            // 9110, 14.2). The library owns the request, and no object of it is constant.
            const_cast<httplib::Request&>(request).ranges.clear();  // NOLINT(*-const-cast)
            return may_pass(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                               : httplib::Server::HandlerResponse::Handled;
        });
        server.set_error_handler([](const httplib::Request&, httplib::Response& response) {
            if (response.body.empty() && response.status != 304)
                answer(response, response.status, "the request is refused");
        });
        const auto all = [this](const httplib::Request& request, httplib::Response& response) {
            handle(request, response);
        };
        constexpr const char* any = R"(/.*)";
        server.Get(any, all).Post(any, all).Put(any, all).Delete(any, all);
    }
};

HttpServer::HttpServer(HttpOptions options) : state_(std::make_unique<State>()) {
    state_->options = std::move(options);
    state_->set_up();
    const HttpOptions& given = state_->options;
    state_->port = given.port > 0
                       ? (state_->server.bind_to_port(given.address.c_str(), given.port) ? given.port : -1)
                       : state_->server.bind_to_any_port(given.address.c_str());
    if (state_->port < 0) {
        throw FaultError(
            fmt::format("port {} of {} cannot be used: another program has it, or it is not allowed",
                        given.port, given.address));
    }
}

HttpServer::~HttpServer() = default;

void HttpServer::route(const std::string& method, const std::string& pattern, HttpHandler handler) {
    state_->routes.push_back({method, pattern, parts_of(pattern), std::move(handler)});
}

std::vector<std::string> HttpServer::routes() const {
    std::vector<std::string> all;
    all.reserve(state_->routes.size());
    for (const Route& route : state_->routes) all.push_back(route.method + " " + route.pattern);
    return all;
}

int HttpServer::port() const { return state_->port; }
const HttpOptions& HttpServer::options() const { return state_->options; }
void HttpServer::serve() { state_->server.listen_after_bind(); }
bool HttpServer::stopping() const { return state_->stops; }

void HttpServer::stop() {
    state_->stops = true;
    state_->server.stop();
}

std::string random_token() {
    std::ifstream random("/dev/urandom", std::ios::binary);
    std::array<char, 16> bytes{};
    if (!random.read(bytes.data(), bytes.size())) throw FaultError("/dev/urandom cannot be read");
    std::string token;
    for (const char byte : bytes) token += fmt::format("{:02x}", static_cast<unsigned char>(byte));
    return token;
}

}  // namespace lamella
