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

std::string grouped(std::size_t n);  ///< "1,360"
/// "1 triangle", "1,360 triangles".
std::string counted(std::size_t n, std::string_view noun);

/// Returns a piece of a file for a message, in quotes: shortened, with unprintable bytes replaced.
std::string excerpt(std::string_view text);

/// Reads a decimal number in the C locale, perhaps among spaces; accepts a plus sign, NaN and infinity in
/// their usual spellings. Overflow gives infinity, underflow zero. Nothing when the token is no number.
std::optional<double> parse_double(std::string_view token);

/// Reads a whole number that fits 64 bits; nothing otherwise.
std::optional<std::int64_t> parse_integer(std::string_view token);

}  // namespace lamella
