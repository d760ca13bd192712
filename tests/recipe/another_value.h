// A value for each setting that it accepts and that is not its default.
#pragma once

#include <algorithm>

#include "recipe/settings.h"

namespace lamella {

/// A value of the setting that differs from its default.
inline Value another_value(const Setting& setting) {
    const Value held = setting.load(Recipe{}, 0);
    switch (setting.type) {
        case ValueType::boolean:
            return !std::get<bool>(held);
        case ValueType::integer:
            return static_cast<std::int64_t>(std::max(setting.limits.lo, setting.limits.hi < 7 ? 2.0 : 7.0));
        case ValueType::number:
            return setting.limits.hi <= 1 ? 0.375 : setting.limits.hi < 3 ? 1.8125 : 3.0625;
        case ValueType::text:
        case ValueType::path:
            return std::string("word");
        case ValueType::lines:
            return std::string("M117 layer {layer}\nM400");
        case ValueType::graded:
            return GradedNumber{"3 + x / 64", ""};
        case ValueType::formula:
            return GradedNumber{"x - 1.5", ""};
        case ValueType::graded_triple:
            return GradedTriple{GradedNumber{1.5, ""}, {"max(1, x) / 64", ""}, {3.0, ""}};
        case ValueType::rows:
            return NumberRows(
                std::max<std::size_t>(setting.shape.rows, 1),
                std::vector<double>(setting.shape.columns, setting.limits.hi <= 1 ? 0.375 : 2.5));
        case ValueType::choice:
            return format_value(held) == setting.choices.back() ? setting.choices.front()
                                                                : setting.choices.back();
        case ValueType::triple:
            return dvec3(1.5, 2.25, 3);
    }
    return held;
}

}  // namespace lamella
