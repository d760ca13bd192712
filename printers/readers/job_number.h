// Numbers as jobs state them: text, JSON, or nothing that makes sense.
#pragma once

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace lamella {

inline constexpr double micrometre = 1e-3;  // mm

/// The finite number that a whole text is; empty where it is none.
inline std::optional<double> parse_number(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

/// A number above 0 (and below 1e12); empty for all others, which are no fact.
inline std::optional<double> positive_or_none(std::optional<double> value) {
    if (!value || !(*value > 0 && *value < 1e12)) return std::nullopt;
    return value;
}

/// A whole number from 0 to a million; empty for all others.
inline std::optional<int> count_or_none(std::optional<double> value) {
    if (!value || !(*value >= 0 && *value <= 1e6) || *value != std::floor(*value)) return std::nullopt;
    return static_cast<int>(*value);
}

/// The number of a key of an object; empty where that is missing or no number.
inline std::optional<double> number_of(const nlohmann::ordered_json& object, const char* key) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_number()) return std::nullopt;
    const double value = object[key].get<double>();
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// The text of a key of an object; "" where that is missing or no text.
inline std::string text_of(const nlohmann::ordered_json& object, const char* key) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_string()) return "";
    return object[key].get<std::string>();
}

}  // namespace lamella
