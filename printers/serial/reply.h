// Reply: a line received from a printer, parsed into a typed reply.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lamella {

enum class ReplyKind : unsigned char {
    other,         ///< echoes, banners, noise: never an answer
    ok,            ///< answers a line; with ADVANCED_OK also `number`, `planner_free`, `slots_free`
    resend,        ///< asks for line `number`
    line_error,    ///< about a checksum or a line number; a resend request follows
    error,         ///< any other error
    fatal,         ///< the printer has given up: halted, overheated, killed
    busy,          ///< a command takes long
    heating,       ///< a command waits for a temperature
    temperatures,  ///< automatic temperature report
    reset,         ///< the board has restarted
    action,        ///< `text` is the action asked of the host: pause, resume, cancel, prompt_...
    capability,    ///< `text` is NAME:0 or NAME:1
    firmware,      ///< `text` is name and version
    grbl_banner,   ///< GRBL has restarted
    grbl_error,    ///< answers a line that GRBL refuses; `number` is the error code
    grbl_alarm,    ///< `number` is the alarm code
    grbl_status,   ///< `text` is the state, such as Idle or Hold:0
    grbl_version,  ///< `text` is the version, such as 1.1h
    grbl_options   ///< `number` is the size of the receive buffer
};

/// Degrees Celsius; a target is 0 if the heater is off.
struct Temperatures {
    double nozzle = 0, nozzle_target = 0, bed = 0, bed_target = 0;
};

struct Reply {
    ReplyKind kind = ReplyKind::other;
    std::optional<std::int64_t> number{};
    std::optional<int> planner_free{};  ///< P of ADVANCED_OK
    std::optional<int> slots_free{};    ///< B of ADVANCED_OK
    std::optional<Temperatures> temperatures{};
    std::string text{};
};

/// Parses a line of Marlin (1.1, 2.x), its relatives, or GRBL 1.1, without its line end. An incomplete or
/// garbled answer is no answer: a line with a single wrong byte in its `ok` is `other`.
Reply parse_reply(std::string_view line);

/// Returns what a reply tells a person: errors, `echo:` lines and notifications. Empty for all others.
std::string message_of(const Reply& reply);

/// Splits received bytes into lines, regardless of how they were chunked. Drops carriage returns. Replaces
/// non-ASCII bytes by '?', so that no word becomes valid by losing a byte.
class ReplyLines {
  public:
    void feed(std::string_view bytes) { waiting_ += bytes; }
    /// Returns the next complete line, or nothing. Cuts lines longer than 512 bytes.
    std::optional<std::string> next();
    void clear() { waiting_.clear(), line_.clear(), at_ = 0; }

  private:
    std::string waiting_;
    std::string line_;
    std::size_t at_ = 0;
};

}  // namespace lamella
