// HttpConnection: requests to a host over HTTP, with bodies that are made while they are sent.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/cancel_token.h"
#include "hosts/transfer/host_error.h"
#include "hosts/transfer/upload_source.h"

namespace lamella {

/// Where a host is, and who asks. Secrets never stand in a message.
struct HostAccess {
    std::string name;                ///< by which people know it; begins every message
    std::string url;                 ///< http://HOST or https://HOST, with a port and a path or without
    std::string key{};               ///< API key, token or password; empty: none
    std::string user{};              ///< for digest authentication with `key` as the password; empty: none
    std::string certificate_file{};  ///< PEM: authorities or certificate to be trusted; empty: the system's
};

struct HostRequest {
    std::string method = "GET";
    std::string path{};                          ///< below the host's URL, with its query
    std::vector<std::string> headers{};          ///< "Name: value"
    std::string content{};                       ///< body, unless `upload` is given
    UploadBytes* upload = nullptr;               ///< body
    std::optional<std::uint64_t> upload_size{};  ///< bytes of `upload`; nothing: it is sent in chunks
    bool once = false;                           ///< a GET that changes something, and must not be sent twice
    std::vector<int> also{};                     ///< statuses besides 200 to 299 that are no failure
    double patience = 20;                        ///< longest time without a byte of the host or to it, s
    /// Called with the bytes of the body that were sent so far; may be empty.
    std::function<void(std::uint64_t bytes)> on_sent{};
};

struct HostResponse {
    int status = 0;
    std::string body;
    std::map<std::string, std::string> headers;  ///< by lower-case name
};

/// A connection to a host. Used by one thread.
class HttpConnection {
  public:
    /// `cancel` may be null.
    explicit HttpConnection(HostAccess access, const CancelToken* cancel = nullptr);
    ~HttpConnection();
    HttpConnection(const HttpConnection&) = delete;
    HttpConnection& operator=(const HttpConnection&) = delete;

    /// Adds a header to every request from now on: "Name: value".
    void send_always(std::string header) { always_.push_back(std::move(header)); }
    /// Sends a request and returns the answer, whatever its status. Throws HostError when there is none,
    /// InputError when the host's certificate is not trusted, Interrupted, and what `upload` throws.
    HostResponse exchange(const HostRequest& request);
    /// As `exchange`, for an answer of 200 to 299 or one of `also`. Throws InputError for a key that is
    /// refused (401, or 403 to a question) and HostError for other answers, with the host's own words.
    HostResponse ask(const HostRequest& request);
    const HostAccess& access() const { return access_; }
    const CancelToken* cancel() const { return cancel_; }
    /// Returns whether everything that is sent can be read on the way.
    bool is_plain() const { return !access_.url.starts_with("https://"); }

  private:
    struct Handles;
    HostAccess access_;
    const CancelToken* cancel_;
    std::vector<std::string> always_;  // headers
    std::unique_ptr<Handles> handles_;
};

/// Returns text as a component of a URL: everything but letters, digits and -._~ is percent-encoded.
std::string url_component(const std::string& text);
/// The same, but slashes stay.
std::string url_path(const std::string& text);

}  // namespace lamella
