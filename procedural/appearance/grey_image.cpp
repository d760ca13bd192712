// Luma of pictures; means over boxes, one axis after the other.
#include "procedural/appearance/grey_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <variant>

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

GreyImage solidity(const Volume& picture, bool invert) {
    require_pixels(picture.size[0] > 0 && picture.size[1] > 0);
    if (picture.size[2] != 1)
        throw InputError("the picture has " + std::to_string(picture.size[2]) + " pages; expected one");
    GreyImage image(static_cast<int>(picture.size[0]), static_cast<int>(picture.size[1]));
    std::visit(
        [&](const auto& samples) {
            if (samples.size() != image.values.size())
                throw InputError("the picture has " + std::to_string(samples.size()) +
                                 " samples; expected one for each pixel");
            for (std::size_t i = 0; i < samples.size(); ++i) {
                const double light =
                    std::clamp(static_cast<double>(samples[i]) / picture.full_scale, 0.0, 1.0);
                image.values[i] = invert ? light : 1 - light;
            }
        },
        picture.samples);
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

double otsu_threshold(const GreyImage& image) {
    constexpr std::size_t bins = 256;
    std::array<double, bins> count{};
    for (const double v : image.values)
        count[std::min(bins - 1, static_cast<std::size_t>(std::max(0.0, v) * bins))] += 1;
    double all = 0, moment = 0;
    for (std::size_t i = 0; i < bins; ++i) {
        all += count[i];
        moment += count[i] * static_cast<double>(i);
    }
    double below = 0, moment_below = 0, best = 0;
    // Where the histogram is empty, all thresholds part it equally: the middle of them is taken.
    std::size_t first = bins / 2, last = bins / 2;
    for (std::size_t i = 1; i < bins; ++i) {
        below += count[i - 1];
        moment_below += count[i - 1] * static_cast<double>(i - 1);
        if (below == 0 || below == all) continue;
        const double means = moment_below / below - (moment - moment_below) / (all - below);
        const double variance = below * (all - below) * means * means;
        if (variance > best) first = i;
        if (variance >= best) last = i;
        best = std::max(best, variance);
    }
    return static_cast<double>(first + last) / (2.0 * bins);
}

GreyImage black_and_white(const GreyImage& image, double threshold) {
    GreyImage crisp = image;
    for (double& value : crisp.values) value = value >= threshold ? 1 : 0;
    return crisp;
}

}  // namespace lamella
