// Stripping, numbering, checksums.
#include "printers/serial/gcode_line.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/error.h"

namespace lamella {
namespace {

bool is_digit(char c) { return '0' <= c && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
char upper(char c) { return 'a' <= c && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// Returns true if the command shows a text, which may be cut.
bool shows_text(const std::string& word) {
    return word == "M117" || word == "M118" || word == "M0" || word == "M1";
}

/// Returns true if the command names a file; the name must be kept unchanged.
bool names_file(const std::string& word) {
    return word == "M23" || word == "M28" || word == "M30" || word == "M32";
}

/// Removes "N12" at the front and "*34" at the end.
std::string_view without_number(std::string_view line) {
    line = line.substr(0, line.find('*'));
    if (line.size() < 2 || upper(line[0]) != 'N' || !is_digit(line[1])) return line;
    std::size_t at = 1;
    while (at < line.size() && (is_digit(line[at]) || is_blank(line[at]))) ++at;
    return line.substr(at);
}

std::string without_comments(std::string_view line) {
    std::string text;
    int depth = 0;
    for (const char c : line) {
        if (c == ';' && depth == 0) break;
        if (c == '(') ++depth;
        if (depth == 0) text += is_blank(c) ? ' ' : upper(c);
        if (c == ')' && depth > 0) --depth;
    }
    return text;
}

/// Turns "1.500" into "1.5" and "2.0" into "2". Leaves anything but a decimal number unchanged.
void drop_trailing_zeros(std::string& word) {
    const auto point = word.find('.');
    if (point == std::string::npos || point + 1 >= word.size()) return;
    if (!std::all_of(word.begin() + static_cast<std::ptrdiff_t>(point) + 1, word.end(), is_digit)) return;
    const bool digits_before = point > 0 && is_digit(word[point - 1]);
    while (word.back() == '0' && (digits_before || word.size() > point + 2)) word.pop_back();
    if (word.back() == '.') word.pop_back();
}

/// Returns the words separated by single blanks.
std::string tidy_words(std::string_view text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        if (text[at] == ' ') {
            ++at;
            continue;
        }
        const auto end = std::min(text.find(' ', at), text.size());
        std::string word(text.substr(at, end - at));
        drop_trailing_zeros(word);
        if (!result.empty()) result += ' ';
        result += word;
        at = end;
    }
    return result;
}

std::string_view trim_spaces(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

/// Returns true if a command is named by a word, such as SET_PIN, instead of a letter and a number.
bool is_named(std::string_view command) {
    const auto is_name = [](char c) { return ('A' <= upper(c) && upper(c) <= 'Z') || c == '_'; };
    return command.size() > 1 && is_name(command[0]) && is_name(command[1]);
}

std::string shown(std::string_view line) {
    std::string text;
    for (const char c : line.substr(0, 60)) text += ' ' <= c && c <= '~' ? c : '?';
    return text;
}

}  // namespace

std::string command_word(std::string_view command) {
    std::string word;
    for (const char c : command) {
        if (word.empty() ? !('A' <= c && c <= 'Z') && c != '$' : !is_digit(c) && c != '.') break;
        if (word.size() == 2 && word[1] == '0' && is_digit(c)) word.pop_back();
        word += c;
    }
    return word;
}

std::optional<double> leading_decimal(std::string_view text, std::size_t& length) {
    double value = 0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
    length = static_cast<std::size_t>(end - text.data());
    return value;
}

std::optional<double> command_value(std::string_view command, char letter) {
    for (std::size_t at = command.find(letter, 1); at != std::string_view::npos;
         at = command.find(letter, at + 1)) {
        std::size_t length = 0;
        if (const auto value = leading_decimal(command.substr(at + 1), length)) return value;
    }
    return std::nullopt;
}

std::string clean_command(std::string_view line, const LineRules& rules) {
    const std::string_view bare = trim_spaces(without_number(trim_spaces(line)));
    std::string start;
    for (const char c : bare.substr(0, 6)) start += upper(c);
    const std::string word = command_word(start);
    std::string command;
    if (rules.keeps_names && is_named(bare)) {
        command = trim_spaces(bare.substr(0, bare.find(';')));
        for (std::size_t i = 0; i < command.size() && command[i] != ' '; ++i) command[i] = upper(command[i]);
    } else if (rules.keeps_text && (shows_text(word) || names_file(word))) {
        for (const char c : bare.substr(0, bare.find(';'))) command += ' ' <= c && c <= '~' ? c : '?';
        for (std::size_t i = 0; i < word.size(); ++i) command[i] = upper(command[i]);
        command = trim_spaces(
            std::string_view(command).substr(0, shows_text(word) ? rules.longest : command.size()));
    } else {
        command = tidy_words(without_comments(bare));
    }
    // M110 is dropped: only the sender numbers lines.
    if (command.empty() || command == "%" || word == "M110") return {};
    if (command[0] == '@') {
        throw InputError(
            "\"" + shown(line) +
            "\" is a command to a host, which no printer reads; accepted: G-code, such as M0 or M600 "
            "for a pause");
    }
    if (command[0] != '$' && !('A' <= command[0] && command[0] <= 'Z'))
        throw InputError("\"" + shown(line) + "\" is no G-code: a line begins with a letter");
    if (!std::all_of(command.begin(), command.end(), [](char c) { return ' ' <= c && c <= '~'; }))
        throw InputError("\"" + shown(line) + "\" holds characters that are no ASCII");
    if (const auto at = command.find_first_of(rules.realtime); at != std::string::npos) {
        throw InputError(
            "\"" + shown(line) + "\" holds " + command[at] +
            ", on which the firmware acts as soon as it arrives; accepted: no ! ~ ? outside comments");
    }
    if (command.size() > rules.longest) {
        throw InputError("the line \"" + shown(line) + "...\" has " + std::to_string(command.size()) +
                         " characters, more than the " + std::to_string(rules.longest) +
                         " that the printer can read");
    }
    return command;
}

unsigned xor_checksum(std::string_view text) {
    unsigned sum = 0;
    for (const char c : text) sum ^= static_cast<unsigned char>(c);
    return sum;
}

std::string numbered_line(std::int64_t number, std::string_view command) {
    std::string line = "N" + std::to_string(number) + " ";
    line += command;
    const unsigned sum = xor_checksum(line);
    line += "*" + std::to_string(sum) + "\n";
    return line;
}

}  // namespace lamella
