#include "engine/base/text.h"

#include <algorithm>
#include <charconv>

#include "engine/base/geometry.h"

namespace lamella {

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

namespace {

char lower_letter(char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    if (text.starts_with(mark)) text.remove_prefix(mark.size());
    return text;
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), lower_letter);
    return lower;
}

bool same_word(std::string_view token, std::string_view lower) {
    return std::ranges::equal(token, lower, {}, lower_letter);
}

std::string grouped(std::uint64_t n) {
    std::string digits = std::to_string(n);
    for (std::size_t i = digits.size(); i > 3;) digits.insert(i -= 3, 1, ',');
    return digits;
}

std::string counted(std::uint64_t n, std::string_view noun) {
    return grouped(n) + " " + std::string(noun) + (n == 1 ? "" : "s");
}

std::string excerpt(std::string_view text) {
    constexpr std::size_t longest = 32;
    std::string out = "\"";
    for (const char c : text.substr(0, longest)) out += c >= ' ' && c <= '~' ? c : '?';
    return out + (text.size() > longest ? "...\"" : "\"");
}

std::optional<double> parse_double(std::string_view token) {
    token = trimmed(token);
    if (!token.empty() && token.front() == '+') token.remove_prefix(1);
    if (token.empty() || token.front() == '+') return std::nullopt;
    double value = 0.0;
    const char* const end = token.data() + token.size();
    const auto [stop, status] = std::from_chars(token.data(), end, value);
    if (status == std::errc::result_out_of_range && stop == end) {
        const bool tiny = token.find("e-") != token.npos || token.find("E-") != token.npos ||
                          token.find_first_of("eE") == token.npos;
        return tiny ? 0.0 : (token.front() == '-' ? -infinity : infinity);
    }
    if (status == std::errc() && stop == end) return value;
    // Old versions of the Microsoft C library wrote 1.#INF, -1.#IND and 1.#QNAN.
    if (token.find(".#") != token.npos) return std::numeric_limits<double>::quiet_NaN();
    return std::nullopt;
}

std::optional<std::int64_t> parse_integer(std::string_view token) {
    token = trimmed(token);
    if (!token.empty() && token.front() == '+') token.remove_prefix(1);
    std::int64_t value = 0;
    const char* const end = token.data() + token.size();
    const auto [stop, status] = std::from_chars(token.data(), end, value);
    if (status != std::errc() || stop != end || token.empty()) return std::nullopt;
    return value;
}

}  // namespace lamella
