// Messages of Klipper's API socket: JSON objects, each followed by the byte 0x03.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace lamella {

constexpr char klipper_message_end = '\x03';

/// What klippy says.
struct KlipperMessage {
    std::optional<std::int64_t> id{};    ///< the request that this answers; empty: it answers none
    std::optional<std::string> error{};  ///< why the request has failed
    std::string topic;                   ///< of a message that answers none: what it was subscribed as
    nlohmann::ordered_json content{};    ///< result of the request, or what the topic tells; an object
};

/// Returns the bytes of a request.
std::string klipper_request(std::int64_t id, std::string_view method, const nlohmann::ordered_json& params);

/// Parses a message without its end. Returns nothing for what is no message.
std::optional<KlipperMessage> parse_klipper_message(std::string_view text);

/// Returns the text with blanks in place of control characters.
std::string without_controls(std::string_view text);

/// Splits received bytes into messages, regardless of how they were chunked.
class KlipperFrames {
  public:
    void feed(std::string_view bytes) { waiting_ += bytes; }
    /// Returns the next complete message, or nothing. Drops messages longer than 4 MiB.
    std::optional<std::string> next();
    void clear() { waiting_.clear(), at_ = 0, skips_ = false; }

  private:
    std::string waiting_;
    std::size_t at_ = 0;  // searched up to here
    bool skips_ = false;  // the message that is arriving is too long
};

}  // namespace lamella
