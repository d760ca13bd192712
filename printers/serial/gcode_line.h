// Preparation of G-code lines for sending: stripping, numbering, checksums.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lamella {

/// Longest line that Marlin reads, characters (MAX_CMD_SIZE less the line end).
constexpr std::size_t longest_marlin_line = 95;
/// Longest line that GRBL accepts, characters (error:11 beyond).
constexpr std::size_t longest_grbl_line = 80;
/// Longest line for Klipper, which has no bound of its own, characters.
constexpr std::size_t longest_klipper_line = 4096;
/// Longest command: leaves room for a line number of 8 digits and a checksum of 3.
constexpr std::size_t longest_command = longest_marlin_line - 14;

/// How a job is sent to a machine, and which lines it takes.
enum class Dialect : unsigned char {
    marlin,  ///< numbered lines with checksums: Marlin and its relatives
    grbl,    ///< plain lines, counted by their characters
    klipper  ///< scripts over the API socket of klippy
};

/// What firmware accepts as a line.
struct LineRules {
    std::size_t longest;        ///< most characters of a command
    bool keeps_text;            ///< commands may carry a text for the display or the name of a file
    std::string_view realtime;  ///< characters that the firmware takes out of the stream and acts on at once
    bool keeps_names = false;   ///< commands may be words, such as SET_PIN PIN=lamp, with values as written
};
constexpr LineRules marlin_lines{longest_command, true, ""};
/// `!` holds the motion, `~` continues it, `?` asks for the state, wherever they stand.
constexpr LineRules grbl_lines{longest_grbl_line, false, "!~?"};
/// Commands whose first word is longer than a letter and a number are kept as they are: their values are
/// names.
constexpr LineRules klipper_lines{longest_klipper_line, true, "", true};
constexpr const LineRules& line_rules(Dialect dialect) {
    return dialect == Dialect::grbl ? grbl_lines : dialect == Dialect::klipper ? klipper_lines : marlin_lines;
}

/// Strips a line of a job: removes comments, surplus blanks, line numbers, checksums and trailing zeros, and
/// converts it to capitals. Returns an empty string if nothing is left to send. Where the rules keep texts,
/// text for the display (M0, M1, M117, M118) is kept but may be cut, and the file name of M23, M28, M30 and
/// M32 is kept unchanged. Throws InputError for a line that is too long, for one that is not a command, and
/// for one with a real-time character outside its comments.
std::string clean_command(std::string_view line, const LineRules& rules = marlin_lines);

/// Returns the decimal number that a text begins with, and its length. As firmware reads it: "10E5" is 10,
/// since E begins the next word, and "INF" is none.
std::optional<double> leading_decimal(std::string_view text, std::size_t& length);
/// Returns the number behind a letter, such as 10 for 'X' in "G1 X10". The command's own word does not count.
std::optional<double> command_value(std::string_view command, char letter);

/// Returns the XOR of all bytes.
unsigned xor_checksum(std::string_view text);

/// Returns the line as sent, such as "N5 G28*22" with a line end.
std::string numbered_line(std::int64_t number, std::string_view command);

/// Returns the letter and number that a command begins with, such as G28 of "G28 X". Drops leading zeros.
std::string command_word(std::string_view command);

}  // namespace lamella
