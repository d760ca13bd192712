// Parses "A:B".
#include "recipe/layer_range.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "engine/base/error.h"

namespace lamella {

LayerRange parse_layers(const std::string& text, int count) {
    LayerRange range{0, count};
    const auto refuse = [&](const std::string& wrong) {
        throw InputError(fmt::format(
            "--layers: {}; accepted: A:B with 0 <= A < B <= {} (layers A up to, not including, B)", wrong,
            count));
    };
    if (text.empty()) return range;
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos) refuse("\"" + text.substr(0, 64) + "\" has no colon");
    const auto side = [&](std::string_view digits, int& out) {
        if (digits.empty()) return;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), out);
        if (error != std::errc{} || end != digits.data() + digits.size()) {
            refuse("\"" + std::string(digits.substr(0, 64)) + "\" is not a whole number");
        }
    };
    side(std::string_view(text).substr(0, colon), range.first);
    side(std::string_view(text).substr(colon + 1), range.last);
    if (range.first < 0 || range.first >= range.last || range.last > count) {
        refuse(fmt::format("{}:{} is not a range of the job's layers", range.first, range.last));
    }
    return range;
}

}  // namespace lamella
