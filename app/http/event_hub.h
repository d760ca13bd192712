// EventHub: events for the pages and programs that listen to a session.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

namespace lamella {

/// Hands events to listeners as server-sent events. Thread-safe. A listener that does not keep up loses the
/// oldest events, never the newest.
class EventHub {
  public:
    /// A listener's queue.
    class Listener {
      public:
        /// Returns the next event as text of the stream; a comment after `patience_seconds` without one.
        std::string next(int patience_seconds);

      private:
        friend class EventHub;
        static constexpr std::size_t most_waiting = 256;

        std::mutex mutex_;
        std::condition_variable changed_;
        std::deque<std::string> waiting_;
        bool ended_ = false;
    };

    /// Returns a listener for a session, as long as it is kept. Throws HttpError 503 for more than eight.
    std::shared_ptr<Listener> listen(const std::string& session);
    /// Sends an event to the session's listeners; to all for an empty session.
    void send(const std::string& session, const std::string& event, const nlohmann::ordered_json& data);
    /// Wakes all listeners, for good.
    void end();

  private:
    std::mutex mutex_;
    bool ended_ = false;
    std::multimap<std::string, std::weak_ptr<Listener>> listeners_;
};

}  // namespace lamella
