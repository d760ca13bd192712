// Replies of printers: one line in, one typed reply out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lamella {

enum class ReplyKind : unsigned char {
    other,         ///< echoes, banners, noise: never an answer
    ok,            ///< answers a line; `number`, `planner_free`, `slots_free` with ADVANCED_OK
    resend,        ///< asks for line `number`
    line_error,    ///< about a checksum or a line number; a resend follows
    error,         ///< any other complaint
    fatal,         ///< the printer has given up: halted, overheated, killed
    busy,          ///< a command takes long
    heating,       ///< a command waits for a temperature
    temperatures,  ///< reported by itself
    reset,         ///< the board has begun anew
    action,        ///< `text` is what the host is to do: pause, resume, cancel, prompt_...
    capability,    ///< `text` is NAME:0 or NAME:1
    firmware,      ///< `text` is its name and version
    grbl_banner,   ///< GRBL has begun anew
    grbl_error,    ///< answers a line: refused, `number` says why
    grbl_alarm,    ///< `number` says why
    grbl_status,   ///< `text` is the state, such as Idle or Hold:0
    grbl_options   ///< `number` is the size of its receive buffer
};

/// Degrees Celsius; targets are 0 where nothing is heated.
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

/// What a line of Marlin (1.1, 2.x), its relatives, or GRBL 1.1 says. The line is without its end. What is
/// not wholly an answer is none: a line with a single wrong byte in its `ok` is `other`.
Reply parse_reply(std::string_view line);

/// Cuts what arrives into lines, wherever it was split. Carriage returns are dropped, bytes that are no ASCII
/// become '?', so that they never complete a word by vanishing.
class ReplyLines {
  public:
    void feed(std::string_view bytes) { waiting_ += bytes; }
    /// The next complete line, or nothing. Longer ones than 512 bytes are cut.
    std::optional<std::string> next();
    void clear() { waiting_.clear(), line_.clear(), at_ = 0; }

  private:
    std::string waiting_;
    std::string line_;
    std::size_t at_ = 0;
};

}  // namespace lamella
