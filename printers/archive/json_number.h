// Numbers of JSON records that a damaged file may hold.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace lamella {

/// Throws the nlohmann::json::exception of a value of another type than the one that is expected.
[[noreturn]] inline void throw_not_as_expected() {
    const nlohmann::ordered_json nothing;
    (void)nothing.get<std::string>();
    std::abort();  // get() has thrown
}

/// Returns a whole number. Throws nlohmann::json::exception for any other value and for a number that does
/// not fit the type: get() converts both without a check, which is undefined for 1e300.
template <typename Whole>
Whole whole_number(const nlohmann::ordered_json& json) {
    if (json.is_number_unsigned()) {
        if (const auto number = json.get<std::uint64_t>(); std::in_range<Whole>(number))
            return static_cast<Whole>(number);
    } else if (json.is_number_integer()) {
        if (const auto number = json.get<std::int64_t>(); std::in_range<Whole>(number))
            return static_cast<Whole>(number);
    }
    throw_not_as_expected();
}

/// The greatest magnitude of a number that format_number writes.
inline constexpr double max_written_number = 1e9;

/// Returns a number that format_number can write. Throws nlohmann::json::exception for any other value.
inline double written_number(const nlohmann::ordered_json& json) {
    const double number = json.get<double>();
    if (!(std::abs(number) <= max_written_number)) throw_not_as_expected();
    return number;
}

}  // namespace lamella
