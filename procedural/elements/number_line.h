// Lines of numbers with commas between them, as files of elements hold them.
#pragma once

#include <cmath>
#include <string_view>
#include <vector>

#include "engine/base/text.h"

namespace lamella {

/// Returns the numbers of a line, separated by commas; of one that holds something else, or a number that is
/// not finite, those before it.
inline std::vector<double> numbers_of_line(std::string_view line) {
    std::vector<double> numbers;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        const auto number = parse_double(line.substr(begin, end - begin));
        if (!number || !std::isfinite(*number)) break;
        numbers.push_back(*number);
        begin = end + 1;
    }
    return numbers;
}

}  // namespace lamella
