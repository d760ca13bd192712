// PrintMessages: what was said during a print.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace lamella {

struct LinkStatus;

/// Keeps the last messages of a print, numbered from 1. Thread-safe.
class PrintMessages {
  public:
    /// `on_message` is told each new one, as {"print", "number", "text"}.
    PrintMessages(int print, std::function<void(const nlohmann::ordered_json&)> on_message)
        : print_(print), on_message_(std::move(on_message)) {}

    /// Adds a message, unless it is empty.
    void add(const std::string& text);
    nlohmann::ordered_json json() const;

  private:
    static constexpr std::size_t most_kept = 200;

    int print_;
    std::function<void(const nlohmann::ordered_json&)> on_message_;
    mutable std::mutex mutex_;
    std::int64_t next_ = 1;
    std::deque<nlohmann::ordered_json> kept_;
};

/// Adds what a person has to know of a print to its messages, when it becomes known.
class PrintRemarks {
  public:
    explicit PrintRemarks(PrintMessages& messages) : messages_(messages) {}
    void look(const LinkStatus& status);

  private:
    void tell_once(const std::string& text, std::string& told);

    PrintMessages& messages_;
    std::string awaiting_, firmware_, wait_, journal_, lost_;
    int notices_ = 0;
};

}  // namespace lamella
