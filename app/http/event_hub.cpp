// Queues of text, one a listener.
#include "app/http/event_hub.h"

#include <chrono>

#include "app/http/http_server.h"

namespace lamella {

std::string EventHub::Listener::next(int patience_seconds) {
    std::unique_lock lock(mutex_);
    // Short waits, so that a server that stops is noticed.
    for (int second = 0; second < patience_seconds && waiting_.empty() && !ended_; ++second)
        changed_.wait_for(lock, std::chrono::seconds(1), [this] { return ended_ || !waiting_.empty(); });
    if (waiting_.empty()) return ": still here\n\n";
    std::string text = std::move(waiting_.front());
    waiting_.pop_front();
    return text;
}

std::shared_ptr<EventHub::Listener> EventHub::listen(const std::string& session) {
    constexpr std::size_t most_listeners = 8;
    const std::lock_guard lock(mutex_);
    std::erase_if(listeners_, [](const auto& item) { return item.second.expired(); });
    if (listeners_.size() >= most_listeners) throw HttpError(503, "too many listen to events already");
    auto listener = std::make_shared<Listener>();
    listener->ended_ = ended_;
    listeners_.emplace(session, listener);
    return listener;
}

void EventHub::send(const std::string& session, const std::string& event,
                    const nlohmann::ordered_json& data) {
    const std::string text =
        "event: " + event +
        "\ndata: " + data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n\n";
    const std::lock_guard lock(mutex_);
    for (const auto& [name, weak] : listeners_) {
        const auto listener = weak.lock();
        if (!listener || (!session.empty() && name != session)) continue;
        const std::lock_guard queue(listener->mutex_);
        listener->waiting_.push_back(text);
        if (listener->waiting_.size() > Listener::most_waiting) listener->waiting_.pop_front();
        listener->changed_.notify_one();
    }
}

void EventHub::end() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    for (const auto& [name, weak] : listeners_) {
        const auto listener = weak.lock();
        if (!listener) continue;
        const std::lock_guard queue(listener->mutex_);
        listener->ended_ = true;
        listener->changed_.notify_one();
    }
}

}  // namespace lamella
