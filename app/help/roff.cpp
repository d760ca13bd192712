// Letters and words that mean something to roff.
#include "app/help/roff.h"

namespace lamella {
namespace {

std::string roff_letter(char c) {
    switch (c) {
        case '\\':
            return "\\e";
        case '-':
            return "\\-";
        case '\'':
            return "\\(aq";
        case '`':
            return "\\(ga";
        case '^':
            return "\\(ha";
        case '~':
            return "\\(ti";
        default:
            return {c};
    }
}

/// Whether a word is an option, perhaps in a bracket: its hyphens are not those of prose.
bool begins_option(std::string_view text, std::size_t at) {
    if (text[at] != '-' || at + 1 >= text.size() || text[at + 1] == ' ') return false;
    return at == 0 || std::string_view(" (\"").find(text[at - 1]) != std::string_view::npos;
}

/// A line that begins with a dot or a quote would be a request.
std::string guarded(std::string text) {
    if (text.starts_with('.') || text.starts_with('\'')) text.insert(0, "\\&");
    return text;
}

}  // namespace

std::string roff_literal(std::string_view text) {
    std::string result;
    for (const char c : text) result += roff_letter(c);
    return guarded(result);
}

std::string roff_prose(std::string_view text) {
    std::string result;
    bool quoted = false, option = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '`') {
            quoted = !quoted;
            result += quoted ? "\\fB" : "\\fR";
        } else if (quoted) {
            result += roff_letter(c);
        } else {
            if (begins_option(text, i)) option = true;
            if (c == ' ' || c == '\n') option = false;
            const bool plain = c == '\'' || (c == '-' && !option);
            result += c == '\n' ? " " : plain ? std::string(1, c) : roff_letter(c);
        }
    }
    return guarded(quoted ? result + "\\fR" : result);
}

}  // namespace lamella
