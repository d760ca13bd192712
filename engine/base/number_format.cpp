// Numbers as text by scaling to an integer and writing its digits.
#include "engine/base/number_format.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "engine/base/error.h"

namespace lamella {

void append_number(std::string& out, double value, int decimals) {
    static constexpr std::array<std::uint64_t, 10> powers = {
        1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000, 1000000000};
    if (!(std::abs(value) <= 1e9)) throw FaultError("a number to be written is not finite or exceeds 1e9");
    if (decimals < 0 || decimals > 9) throw FaultError("a number can be written with 0 to 9 decimals");
    const std::uint64_t scale = powers[static_cast<std::size_t>(decimals)];
    const double scaled = std::abs(value) * static_cast<double>(scale);
    auto units = static_cast<std::uint64_t>(scaled);
    // Adding one half before truncating would round 0.49999999999999994 up.
    if (scaled - static_cast<double>(units) >= 0.5) ++units;
    if (value < 0 && units > 0) out.push_back('-');
    std::array<char, 24> digits;
    const auto whole = std::to_chars(digits.data(), digits.data() + digits.size(), units / scale);
    out.append(digits.data(), whole.ptr);
    std::uint64_t rest = units % scale;
    if (rest == 0) return;
    out.push_back('.');
    for (std::uint64_t place = scale / 10; rest > 0; place /= 10) {
        out.push_back(static_cast<char>('0' + rest / place));
        rest %= place;
    }
}

std::string format_number(double value, int decimals) {
    std::string text;
    append_number(text, value, decimals);
    return text;
}

}  // namespace lamella
