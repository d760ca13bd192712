// Parsing of the numbers in job files, from text or JSON; invalid values become empty.
#pragma once

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace lamella {

inline constexpr double micrometre = 1e-3;  // mm

/// Parses the whole text as a finite number; empty if it is not one.
inline std::optional<double> parse_number(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

/// Returns the value if it is above 0 and below 1e12; otherwise empty, because it states nothing useful.
inline std::optional<double> positive_or_none(std::optional<double> value) {
    if (!value || !(*value > 0 && *value < 1e12)) return std::nullopt;
    return value;
}

/// Returns the value if it is a whole number from 0 to a million; otherwise empty.
inline std::optional<int> count_or_none(std::optional<double> value) {
    if (!value || !(*value >= 0 && *value <= 1e6) || *value != std::floor(*value)) return std::nullopt;
    return static_cast<int>(*value);
}

/// Returns the finite number of a key of an object; empty if the key is missing or not a number.
inline std::optional<double> number_of(const nlohmann::ordered_json& object, const char* key) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_number()) return std::nullopt;
    const double value = object[key].get<double>();
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Returns the text of a key of an object; "" if the key is missing or not a text.
inline std::string text_of(const nlohmann::ordered_json& object, const char* key) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_string()) return "";
    return object[key].get<std::string>();
}

}  // namespace lamella
