// Grey images from pictures, and box filters against blocks and fine subdivision.
#include "procedural/appearance/grey_image.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/base/error.h"

namespace grey_image_test {

using namespace lamella;

namespace {

GreyImage noise(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    GreyImage image(width, height);
    for (double& v : image.values) v = static_cast<double>(random() % 1001) / 1000;
    return image;
}

double mean(const GreyImage& image) {
    double sum = 0;
    for (const double v : image.values) sum += v;
    return sum / static_cast<double>(image.values.size());
}

}  // namespace

TEST_CASE("black is solid, white is empty, and inverted the other way round", "[optimization]") {
    // The lower row first.
    const Volume picture{{2, 2, 1}, std::vector<std::uint8_t>{54, 182, 0, 255}, 255, {}};
    const GreyImage image = solidity(picture), inverted = solidity(picture, true);
    REQUIRE(image.width == 2);
    REQUIRE(image.height == 2);
    CHECK(image.values[image.index(0, 1)] == 1.0);
    CHECK(image.values[image.index(1, 1)] == 0.0);
    CHECK(image.values[image.index(0, 0)] == Approx(1 - 54.0 / 255));
    CHECK(image.values[image.index(1, 0)] == Approx(1 - 182.0 / 255));
    for (std::size_t i = 0; i < image.values.size(); ++i)
        CHECK(inverted.values[i] == Approx(1 - image.values[i]).margin(1e-12));
}

TEST_CASE("a picture scaled by a whole factor has the means of blocks", "[optimization]") {
    const GreyImage image = noise(12, 8, 1), scaled = box_filtered(image, 3);
    REQUIRE(scaled.width == 3);
    REQUIRE(scaled.height == 2);
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            double sum = 0;
            for (int k = 0; k < 16; ++k) sum += image.values[image.index(4 * x + k % 4, 4 * y + k / 4)];
            CHECK(scaled.values[scaled.index(x, y)] == Approx(sum / 16).epsilon(1e-12));
        }
    }
}

TEST_CASE("a picture scaled by any factor has the means over the areas of pixels", "[optimization]") {
    const GreyImage image = noise(10, 15, 2);
    for (const int width : {1, 4, 7, 10, 13}) {
        const GreyImage scaled = box_filtered(image, width);
        CAPTURE(width);
        REQUIRE(scaled.height == (3 * width + 1) / 2);
        CHECK(mean(scaled) == Approx(mean(image)).epsilon(1e-12));
        // Parts of 1 / (10 width) by 1 / (15 height) lie in one pixel of either image.
        const int w = scaled.width, h = scaled.height;
        std::vector<double> sums(scaled.values.size(), 0);
        for (int v = 0; v < 15 * h; ++v) {
            for (int u = 0; u < 10 * w; ++u)
                sums[scaled.index(u / 10, v / 15)] += image.values[image.index(u / w, v / h)] / 150;
        }
        for (std::size_t i = 0; i < sums.size(); ++i)
            CHECK(scaled.values[i] == Approx(sums[i]).epsilon(1e-10));
    }
}

TEST_CASE("black and white is solid from the threshold on", "[optimization]") {
    GreyImage image(3, 2);
    image.values = {0, 0.3, 0.5, 0.499, 0.7, 1};
    CHECK(black_and_white(image).values == std::vector<double>{0, 0, 1, 0, 1, 1});
    CHECK(black_and_white(image, 0.3).values == std::vector<double>{0, 1, 1, 1, 1, 1});
    CHECK(black_and_white(image).width == 3);
    CHECK(black_and_white(image).height == 2);
}

TEST_CASE("Otsu's threshold parts two classes, wherever they lie", "[optimization]") {
    // Against the definition: the threshold of the largest variance between the classes, over all of them.
    for (const unsigned seed : {1U, 2U, 3U}) {
        GreyImage image = noise(40, 30, seed);
        for (std::size_t i = 0; i < image.values.size(); ++i)
            image.values[i] = i % 3 == 0 ? 0.7 + 0.2 * image.values[i] : 0.1 + 0.3 * image.values[i];
        const double threshold = otsu_threshold(image);
        CHECK(threshold > 0.39);
        CHECK(threshold < 0.71);
        double best = 0, found = 0;
        for (int t = 1; t < 256; ++t) {
            double low = 0, high = 0, low_sum = 0, high_sum = 0;
            for (const double v : image.values) {
                const double bin = std::floor(v * 256);
                (bin < t ? low : high) += 1;
                (bin < t ? low_sum : high_sum) += bin;
            }
            if (low == 0 || high == 0) continue;
            const double between = low * high * std::pow(low_sum / low - high_sum / high, 2);
            best = std::max(best, between);
            if (t == static_cast<int>(256 * threshold)) found = between;
        }
        CHECK(found == Approx(best).epsilon(1e-9));
    }
    CHECK(otsu_threshold(GreyImage(4, 4, 0.3)) == 0.5);
}

TEST_CASE("pictures without pixels and widths below one are refused", "[optimization]") {
    CHECK_THROWS_AS(solidity(Volume{}), InputError);
    CHECK_THROWS_AS(solidity(Volume{{2, 2, 1}, std::vector<std::uint8_t>{1, 2, 3}, 255, {}}), InputError);
    CHECK_THROWS_AS(solidity(Volume{{1, 1, 2}, std::vector<std::uint8_t>{1, 2}, 255, {}}), InputError);
    CHECK_THROWS_AS(box_filtered(GreyImage(), 3), InputError);
    CHECK_THROWS_AS(box_filtered(noise(4, 4, 3), 0), InputError);
}

}  // namespace grey_image_test
