// Text in messages and files: counts, excerpts, numbers, white space. Nothing depends on the locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lamella {

/// Returns true for the six white-space characters of the C locale.
constexpr bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\v' || c == '\f';
}

/// Returns the text without white space at its ends.
std::string_view trimmed(std::string_view text);

/// Returns the text without a UTF-8 byte order mark at its start, as editors and spreadsheets write.
std::string_view without_byte_order_mark(std::string_view text);

/// Returns the text with the letters A to Z in lower case.
std::string lower_case(std::string_view text);
/// Returns true if the token is the word, whatever its letters' case; `lower` is in lower case.
bool same_word(std::string_view token, std::string_view lower);

std::string grouped(std::uint64_t n);  ///< "1,360"
/// Returns a count with its noun: "1 triangle", "1,360 triangles".
std::string counted(std::uint64_t n, std::string_view noun);

/// Returns a quoted excerpt of a file for a message: shortened, with unprintable bytes replaced.
std::string excerpt(std::string_view text);

/// Parses a decimal number in the C locale, white space around it allowed; accepts a plus sign, NaN and
/// infinity in their usual spellings. Overflow gives infinity, underflow zero. Returns nothing when the token
/// is no number.
std::optional<double> parse_double(std::string_view token);

/// Parses an integer that fits 64 bits; returns nothing otherwise.
std::optional<std::int64_t> parse_integer(std::string_view token);

}  // namespace lamella
