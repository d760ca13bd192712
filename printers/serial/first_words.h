// FirstWords: what a port says before a printer is known at it, and what that tells about the connection.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lamella {

enum class FirstWordsKind : unsigned char {
    silence,  ///< nothing
    text,     ///< readable text
    garbage,  ///< bytes that are no text, as at a wrong baud rate
    echo      ///< what was sent comes back
};

/// Judges the bytes that arrive before a printer has answered.
class FirstWords {
  public:
    /// `request` is the line that asks the printer for its first answer.
    explicit FirstWords(std::string request) : request_(std::move(request)) {}

    void take(std::string_view bytes);
    FirstWordsKind kind() const;
    /// Returns what to make of it at a baud rate, as a clause without a full stop; empty for silence.
    std::string remark(int baud) const;
    /// Returns why no printer was found, and what would be accepted.
    std::string failure(int baud) const;

  private:
    std::string request_;
    std::string line_;       // the line that is arriving
    std::string last_line_;  // the last readable one
    std::size_t bytes_ = 0, strange_ = 0;
    bool echoed_ = false;
};

}  // namespace lamella
