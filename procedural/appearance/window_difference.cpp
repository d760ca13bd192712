// The broken line, and the rows of an image in the order of windows.
#include "procedural/appearance/window_difference.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/deterministic_math.h"
#include "engine/base/error.h"

namespace lamella {
namespace {

constexpr int largest_window = 64;       // sums stay below 2^31
constexpr std::size_t corner_step = 16;  // of the broken line, and bytes of the shortest SIMD vector

}  // namespace

WindowDifference::WindowDifference(int size, double exponent) : size_(size) {
    if (size < 1 || size > largest_window)
        throw InputError("neighbourhood = " + std::to_string(size) + "; expected 1 to " +
                         std::to_string(largest_window) + " pixels");
    if (!(exponent >= 1 && exponent <= 2))
        throw InputError("exponent = " + std::to_string(exponent) + "; expected 1 to 2");
    row_bytes_ = (static_cast<std::size_t>(size) + corner_step - 1) / corner_step * corner_step;
    std::array<double, 17> corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
        corners[i] = power(static_cast<double>(i * corner_step), exponent);
    // The last slope is the steepest. Slopes are to fit a byte, corners two.
    const double scale = std::min(255.0 * corner_step / (corners[16] - corners[15]), 65535.0 / corners[15]);
    for (std::size_t i = 0; i < corner_step; ++i) {
        bases_[i] = static_cast<std::uint32_t>(std::lround(scale * corners[i]));
        slopes_[i] =
            static_cast<std::uint32_t>(std::lround(scale * (corners[i + 1] - corners[i]) / corner_step));
        bases_[i] = std::min(bases_[i], 65535U);
        slopes_[i] = std::min(slopes_[i], 255U);
    }
    unit_ = scale * power(255.0, exponent);
}

std::vector<std::uint8_t> WindowDifference::all_rows(std::span<const std::uint8_t> image, int width,
                                                     int height) const {
    const int columns = std::max(0, width - size_ + 1);
    std::vector<std::uint8_t> rows(window_begin(columns, 0, height), 0);
    for (int x = 0; x < columns; ++x) {
        for (int y = 0; y < height; ++y) {
            const auto from =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
            std::copy_n(image.data() + from, size_, rows.data() + window_begin(x, y, height));
        }
    }
    return rows;
}

}  // namespace lamella
