// Parser of replies, word by word.
#include "printers/serial/reply.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "engine/base/text.h"

namespace lamella {
namespace {

std::string_view trim_blanks(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

template <typename Number>
std::optional<Number> leading_number(std::string_view text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end == text.data()) return std::nullopt;
    return value;
}

/// Parses the whole text as a non-negative number.
template <typename Number>
std::optional<Number> parsed_whole(std::string_view text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < 0) return std::nullopt;
    return value;
}

/// Reads the two numbers of "T:20.5 /60.0": actual and target temperature.
bool read_heater(std::string_view text, std::string_view key, double& is, double& wanted) {
    std::size_t at = text.find(key);
    // "@:0 B@:0" contains similar keys. A heater's key stands at the front or after a blank.
    while (at != std::string_view::npos && at > 0 && text[at - 1] != ' ') at = text.find(key, at + 1);
    if (at == std::string_view::npos) return false;
    const std::string_view rest = text.substr(at + key.size());
    const auto now = leading_number<double>(rest);
    if (!now) return false;
    is = *now;
    const std::string_view words = rest.substr(0, rest.find(':'));
    if (const auto slash = words.find('/'); slash != std::string_view::npos)
        wanted = leading_number<double>(words.substr(slash + 1)).value_or(0);
    return true;
}

std::optional<Temperatures> read_temperatures(std::string_view text) {
    Temperatures found;
    const bool nozzle = read_heater(text, "T:", found.nozzle, found.nozzle_target) ||
                        read_heater(text, "T0:", found.nozzle, found.nozzle_target);
    const bool bed = read_heater(text, "B:", found.bed, found.bed_target);
    if (!nozzle && !bed) return std::nullopt;
    return found;
}

/// Parses "N16 P0 B2". Each word must be complete and occur at most once; otherwise all are ignored.
void read_advanced(std::string_view words, Reply& reply) {
    Reply found;
    while (!words.empty()) {
        const std::string_view word = words.substr(0, words.find(' '));
        words = trim_blanks(words.substr(word.size()));
        const auto value = parsed_whole<std::int64_t>(word.substr(1));
        if (!value || *value > 1'000'000'000) return;
        if (word[0] == 'N') found.number = *value;
        if (word[0] == 'P') found.planner_free = static_cast<int>(*value);
        if (word[0] == 'B') found.slots_free = static_cast<int>(*value);
        if (word[0] != 'N' && word[0] != 'P' && word[0] != 'B') return;
    }
    reply.number = found.number;
    reply.planner_free = found.planner_free;
    reply.slots_free = found.slots_free;
}

Reply read_ok(std::string_view line) {
    Reply reply{ReplyKind::ok};
    const std::string_view rest = trim_blanks(line.substr(2));
    reply.temperatures = read_temperatures(rest);
    if (!reply.temperatures) read_advanced(rest, reply);
    return reply;
}

/// Parses "Resend: 5", "Resend:5", "rs 5", "rs N5", "Resend: N:5".
std::optional<std::int64_t> read_resend(std::string_view line) {
    const std::string text = lower_case(line);
    std::string_view rest;
    if (text.starts_with("resend")) {
        rest = std::string_view(text).substr(6);
    } else if (text.starts_with("rs ")) {
        rest = std::string_view(text).substr(2);
    } else {
        return std::nullopt;
    }
    const auto digit = rest.find_first_not_of(" :n");
    if (digit == std::string_view::npos || digit == 0) return std::nullopt;
    const auto number = leading_number<std::int64_t>(rest.substr(digit));
    if (!number || *number < 0) return std::nullopt;
    return number;
}

bool mentions_any(std::string_view text, std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(),
                       [&](const char* word) { return text.find(word) != std::string_view::npos; });
}

ReplyKind error_kind(const std::string& text) {
    if (mentions_any(text, {"printer halted", "kill()", "heating failed", "thermal runaway", "mintemp",
                            "maxtemp", "emergency shutdown", "printer stopped"}))
        return ReplyKind::fatal;
    if (mentions_any(text, {"checksum", "line number", "expected line"})) return ReplyKind::line_error;
    return ReplyKind::error;
}

/// Returns true for the first words of a restarted Marlin board, after an optional "echo:".
bool tells_reset(const std::string& text) {
    std::string_view words = text;
    if (words.starts_with("echo:")) words = trim_blanks(words.substr(5));
    constexpr std::array<const char*, 6> causes{"start",           "powerup",        "external reset",
                                                "brown out reset", "watchdog reset", "software reset"};
    return std::any_of(causes.begin(), causes.end(), [&](const char* cause) { return words == cause; });
}

Reply read_grbl(std::string_view line) {
    Reply reply;
    const auto numbered = [&](std::string_view front, ReplyKind kind) {
        if (!line.starts_with(front)) return false;
        reply.number = parsed_whole<std::int64_t>(line.substr(front.size()));
        if (reply.number) reply.kind = kind;
        return reply.number.has_value();
    };
    if (numbered("error:", ReplyKind::grbl_error) || numbered("ALARM:", ReplyKind::grbl_alarm)) return reply;
    if (line.starts_with("Grbl ")) {
        reply.kind = ReplyKind::grbl_banner;
    } else if (line.size() > 2 && line.front() == '<' && line.back() == '>') {
        reply.kind = ReplyKind::grbl_status;
        reply.text = line.substr(1, line.find_first_of("|,>") - 1);
    } else if (line.starts_with("[VER:") && line.back() == ']') {
        // [VER:1.1h.20190830:name]
        const std::string_view version = line.substr(5, line.find_first_of(":]", 5) - 5);
        reply.kind = ReplyKind::grbl_version;
        const auto date = version.rfind('.');
        const bool dated = date != std::string_view::npos && version.size() - date > 6;
        reply.text = dated ? version.substr(0, date) : version;
    } else if (line.starts_with("[OPT:") && line.back() == ']') {
        const std::string_view words = line.substr(0, line.size() - 1);
        reply.number = parsed_whole<std::int64_t>(words.substr(words.rfind(',') + 1));
        if (reply.number) reply.kind = ReplyKind::grbl_options;
    }
    return reply;
}

}  // namespace

Reply parse_reply(std::string_view line) {
    if (line == "ok" || line.starts_with("ok ")) return read_ok(line);
    if (const auto number = read_resend(line)) return {ReplyKind::resend, number};
    const std::string text = lower_case(line);
    Reply reply = read_grbl(line);
    if (reply.text.empty()) reply.text = trim_blanks(line);
    if (reply.kind != ReplyKind::other) return reply;
    if (text.starts_with("error:") || text.find("kill() called") != std::string::npos) {
        reply.kind = error_kind(text);
    } else if (text.starts_with("!!") || text.starts_with("fatal:")) {
        reply.kind = ReplyKind::fatal;
    } else if (text.starts_with("echo:busy:") || text.starts_with("busy:")) {
        reply.kind = ReplyKind::busy;
    } else if (text.starts_with("//action:") || text.starts_with("// action:")) {
        reply.kind = ReplyKind::action;
        reply.text = trim_blanks(line.substr(line.find(':') + 1));
    } else if (text.starts_with("cap:")) {
        reply.kind = ReplyKind::capability;
        reply.text = line.substr(4);
    } else if (const auto at = text.find("firmware_name:"); at != std::string::npos) {
        reply.kind = ReplyKind::firmware;
        reply.text = trim_blanks(line.substr(at + 14));
    } else if (tells_reset(text)) {
        reply.kind = ReplyKind::reset;
    } else if (const std::string_view words = trim_blanks(line);
               words.starts_with("T:") || words.starts_with("T0:") || words.starts_with("B:")) {
        reply.temperatures = read_temperatures(words);
        if (reply.temperatures) {
            const bool waits = words.find(" W:") != std::string_view::npos;
            reply.kind = waits ? ReplyKind::heating : ReplyKind::temperatures;
        }
    }
    return reply;
}

std::string message_of(const Reply& reply) {
    const auto behind = [&](std::string_view front) {
        const std::string_view text = reply.text;
        return text.starts_with(front) ? std::string(trim_blanks(text.substr(front.size()))) : std::string();
    };
    switch (reply.kind) {
        case ReplyKind::error:
        case ReplyKind::fatal:
            return reply.text;
        case ReplyKind::action:
            return behind("notification ");
        case ReplyKind::other:
            return behind("echo:");
        default:
            return {};
    }
}

std::optional<std::string> ReplyLines::next() {
    constexpr std::size_t longest = 512;
    while (at_ < waiting_.size()) {
        const char c = waiting_[at_++];
        if (c == '\n') {
            if (at_ == waiting_.size()) waiting_.clear(), at_ = 0;
            return std::exchange(line_, {});
        }
        if (c == '\r' || line_.size() >= longest) continue;
        line_ += (' ' <= c && c <= '~') || c == '\t' ? c : '?';
    }
    waiting_.clear();
    at_ = 0;
    return std::nullopt;
}

}  // namespace lamella
