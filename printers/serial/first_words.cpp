// Tells silence, text, garbage and echo apart.
#include "printers/serial/first_words.h"

#include <fmt/format.h>

namespace lamella {
namespace {

constexpr std::size_t longest_shown = 60;
constexpr std::size_t enough = 4;  // bytes from which on a judgement is made

/// Returns the baud rates to try, the most common one first.
std::string other_rates(int baud) {
    std::string text;
    for (const int rate : {115200, 250000, 57600, 500000, 1000000}) {
        if (rate == baud) continue;
        text += text.empty() ? fmt::format("--baud {} (then", rate) : fmt::format(" {}", rate);
    }
    return text + ")";
}

}  // namespace

void FirstWords::take(std::string_view bytes) {
    for (const char c : bytes) {
        ++bytes_;
        const bool blank = c == '\n' || c == '\r' || c == '\t';
        const bool readable = ' ' <= c && c <= '~';
        strange_ += readable || blank ? 0 : 1;
        if (c == '\n' || c == '\r') {
            echoed_ = echoed_ || line_ == request_;
            if (!line_.empty()) last_line_ = line_;
            line_.clear();
        } else if (readable && line_.size() < longest_shown) {
            line_ += c;
        }
    }
}

FirstWordsKind FirstWords::kind() const {
    if (echoed_) return FirstWordsKind::echo;
    if (bytes_ >= enough && 4 * strange_ > bytes_) return FirstWordsKind::garbage;
    return bytes_ == 0 ? FirstWordsKind::silence : FirstWordsKind::text;
}

std::string FirstWords::remark(int baud) const {
    switch (kind()) {
        case FirstWordsKind::garbage:
            return fmt::format("what arrives at {} baud is no text: try {}", baud, other_rates(baud));
        case FirstWordsKind::echo:
            return "the port returns what is sent to it: is it a printer's?";
        case FirstWordsKind::text:
            return "it says \"" + (last_line_.empty() ? line_ : last_line_) + "\"";
        default:
            return {};
    }
}

std::string FirstWords::failure(int baud) const {
    switch (kind()) {
        case FirstWordsKind::garbage:
            return fmt::format(
                "what arrives at {} baud is no text, so the printer uses another speed; accepted: its own, "
                "try {}",
                baud, other_rates(baud));
        case FirstWordsKind::echo:
            return "the port only returns what is sent to it, as a modem or a plug that joins both wires "
                   "does; "
                   "accepted: the port of a printer (`lamella ports` lists all)";
        case FirstWordsKind::text:
            return fmt::format(
                "what answers is no printer that was expected: {}; accepted: a printer's port and "
                "--firmware, "
                "and the --baud that it was built with ({} was tried)",
                remark(baud), baud);
        default:
            return fmt::format(
                "the port is silent; accepted: a printer that is switched on, its port (`lamella ports` "
                "lists "
                "all), and the --baud that its firmware was built with ({} was tried)",
                baud);
    }
}

}  // namespace lamella
