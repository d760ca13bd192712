// Lines as they go over a wire: stripped, short, numbered, with a checksum.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lamella {

/// Marlin reads at most so many characters of a line (MAX_CMD_SIZE less its end).
constexpr std::size_t longest_marlin_line = 95;
/// GRBL refuses longer ones (error:11).
constexpr std::size_t longest_grbl_line = 80;
/// What is left for the command where the number takes up to 8 digits and the checksum 3.
constexpr std::size_t longest_command = longest_marlin_line - 14;

/// A line of a job without comments, surplus blanks, line numbers, checksums and trailing zeros, in capitals;
/// empty when nothing is left to send. Text that a command shows (M0, M1, M117, M118) is kept but for its
/// length, the name of a file (M23, M28, M30, M32) as it is. Throws InputError for a line longer than
/// `longest` and for one that is no command.
std::string clean_command(std::string_view line, std::size_t longest = longest_command);

/// XOR of all bytes.
unsigned xor_checksum(std::string_view text);

/// "N5 G28*22" with a line end.
std::string numbered_line(std::int64_t number, std::string_view command);

/// The letter and number a command begins with, such as G28 of "G28 X"; leading zeros are dropped.
std::string command_word(std::string_view command);

}  // namespace lamella
