// WebSocket: texts to and from a host over one connection, without encryption.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "engine/base/cancel_token.h"

namespace lamella {

/// A client's end of a WebSocket (RFC 6455). Used by one thread.
class WebSocket {
  public:
    /// Connects. `name` begins every message; `cancel` may be null. Throws HostError (unreachable),
    /// Interrupted.
    WebSocket(std::string name, const std::string& host, const std::string& port, const std::string& path,
              const CancelToken* cancel);
    ~WebSocket();
    WebSocket(const WebSocket&) = delete;
    WebSocket& operator=(const WebSocket&) = delete;

    /// Throws HostError (unanswered) when the connection is lost, Interrupted.
    void send(const std::string& text);
    /// Returns the next text; nothing when none comes within this time, s. Throws as send().
    std::optional<std::string> receive(double seconds);

  private:
    struct Connection;
    std::unique_ptr<Connection> connection_;
};

}  // namespace lamella
