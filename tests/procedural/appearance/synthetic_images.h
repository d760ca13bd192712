// Images made in code for the tests of appearance.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "procedural/appearance/grey_image.h"

namespace synthetic_images {

using lamella::GreyImage;

/// Waves in random directions, cut to solid and empty with soft edges, in whole steps of 1/255. No two
/// windows are alike.
inline GreyImage waves(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    const auto number = [&] { return static_cast<double>(random() >> 8U) * 0x1p-24; };
    struct Wave {
        double u, v, phase;
    };
    std::vector<Wave> all(12);
    for (Wave& wave : all) {
        const double turn = 6.283185307179586 * number(), count = 0.35 + 0.25 * number();
        wave = {count * std::cos(turn), count * std::sin(turn), 6.283185307179586 * number()};
    }
    GreyImage image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            double sum = 0;
            for (const Wave& wave : all) sum += std::sin(wave.u * x + wave.v * y + wave.phase);
            image.values[image.index(x, y)] = std::round(255 * std::clamp(0.5 + 0.4 * sum, 0.0, 1.0)) / 255;
        }
    }
    return image;
}

/// Independent values in [0, 1].
inline GreyImage noise(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    GreyImage image(width, height);
    for (double& v : image.values) v = static_cast<double>(random() >> 8U) * 0x1p-24;
    return image;
}

inline GreyImage cut_out(const GreyImage& image, int x, int y, int width, int height) {
    GreyImage part(width, height);
    for (int v = 0; v < height; ++v) {
        for (int u = 0; u < width; ++u)
            part.values[part.index(u, v)] = image.values[image.index(x + u, y + v)];
    }
    return part;
}

}  // namespace synthetic_images
