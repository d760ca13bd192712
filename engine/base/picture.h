// A colour image in memory.
#pragma once

#include <cstdint>
#include <vector>

namespace lamella {

/// Rows from top to bottom, three bytes a pixel: red, green, blue.
struct Picture {
    int width = 0;   ///< px
    int height = 0;  ///< px
    std::vector<std::uint8_t> rgb;
};

}  // namespace lamella
