// Luma of pictures; means over boxes, one axis after the other.
#include "procedural/appearance/grey_image.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/error.h"

namespace lamella {
namespace {

/// How much of a pixel of the source lies in a pixel of the result, as a share of the latter.
struct PixelShare {
    int from;
    double weight;
};

/// Returns, for each of `to` equal parts of a line of `from` pixels, the pixels that it covers. All borders
/// are whole multiples of 1 / (from to), so the overlaps are exact.
std::vector<std::vector<PixelShare>> shares_of(int from, int to) {
    std::vector<std::vector<PixelShare>> parts(static_cast<std::size_t>(to));
    const auto f = static_cast<long long>(from), t = static_cast<long long>(to);
    for (long long i = 0; i < t; ++i) {
        for (long long k = i * f / t; k * t < (i + 1) * f; ++k) {
            const long long overlap = std::min((i + 1) * f, (k + 1) * t) - std::max(i * f, k * t);
            parts[static_cast<std::size_t>(i)].push_back(
                {static_cast<int>(k), static_cast<double>(overlap) / static_cast<double>(f)});
        }
    }
    return parts;
}

void require_pixels(bool present) {
    if (!present) throw InputError("the picture has no pixels");
}

}  // namespace

GreyImage solidity(const Picture& picture, bool invert) {
    require_pixels(picture.width > 0 && picture.height > 0);
    GreyImage image(picture.width, picture.height);
    if (picture.rgb.size() != 3 * image.values.size())
        throw InputError("the picture has " + std::to_string(picture.rgb.size()) +
                         " bytes; expected three for each pixel");
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const std::size_t at = 3 * image.index(x, image.height - 1 - y);  // pictures begin at the top
            const double luma =
                0.2126 * picture.rgb[at] + 0.7152 * picture.rgb[at + 1] + 0.0722 * picture.rgb[at + 2];
            const double light = std::clamp(luma / 255, 0.0, 1.0);
            image.values[image.index(x, y)] = invert ? light : 1 - light;
        }
    }
    return image;
}

GreyImage box_filtered(const GreyImage& image, int width) {
    require_pixels(image.width > 0 && image.height > 0);
    if (width < 1)
        throw InputError("a picture of " + std::to_string(width) + " px across; expected at least 1");
    const double proportion = static_cast<double>(image.height) / static_cast<double>(image.width);
    const int height = std::max(1, static_cast<int>(std::lround(proportion * width)));
    const auto columns = shares_of(image.width, width), rows = shares_of(image.height, height);
    GreyImage narrow(width, image.height), scaled(width, height);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < width; ++x) {
            double& sum = narrow.values[narrow.index(x, y)];
            for (const PixelShare& share : columns[static_cast<std::size_t>(x)])
                sum += share.weight * image.values[image.index(share.from, y)];
        }
    }
    for (int y = 0; y < height; ++y) {
        for (const PixelShare& share : rows[static_cast<std::size_t>(y)]) {
            for (int x = 0; x < width; ++x)
                scaled.values[scaled.index(x, y)] +=
                    share.weight * narrow.values[narrow.index(x, share.from)];
        }
    }
    for (double& value : scaled.values) value = std::clamp(value, 0.0, 1.0);  // of rounding
    return scaled;
}

GreyImage black_and_white(const GreyImage& image, double threshold) {
    GreyImage crisp = image;
    for (double& value : crisp.values) value = value >= threshold ? 1 : 0;
    return crisp;
}

}  // namespace lamella
