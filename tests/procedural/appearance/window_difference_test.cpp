// Differences of windows against sums over their pixels, and the broken line against the power.
#include "procedural/appearance/window_difference.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/base/error.h"
#include "engine/base/simd_target.h"

namespace window_difference_test {

using namespace lamella;

TEST_CASE("the difference of windows is the sum over their pixels, on every SIMD target", "[optimization]") {
    struct Restore {
        ~Restore() { force_simd_target(""); }
    } restore;
    constexpr unsigned seed = 7;
    CAPTURE(seed);
    std::mt19937 random(seed);
    constexpr int width = 80, height = 75;
    std::vector<std::uint8_t> a(width * height), b(width * height);
    // Of all differences, also the largest.
    for (auto* image : {&a, &b}) {
        for (std::uint8_t& v : *image)
            v = static_cast<std::uint8_t>(random() % 8 == 0 ? random() % 2 * 255 : random());
    }
    for (const int size : {1, 3, 8, 14, 15, 16, 17, 20, 33, 64}) {
        for (const double exponent : {1.0, 1.2, 2.0}) {
            const WindowDifference difference(size, exponent);
            const auto rows_a = difference.all_rows(a, width, height),
                       rows_b = difference.all_rows(b, width, height);
            std::vector<std::size_t> begins;
            std::vector<std::uint32_t> expected;
            const int ax = static_cast<int>(random() % static_cast<unsigned>(width - size + 1));
            const int ay = static_cast<int>(random() % static_cast<unsigned>(height - size + 1));
            for (int k = 0; k < 8; ++k) {
                const int bx = k == 0 ? width - size
                                      : static_cast<int>(random() % static_cast<unsigned>(width - size + 1));
                const int by = k == 0 ? height - size
                                      : static_cast<int>(random() % static_cast<unsigned>(height - size + 1));
                begins.push_back(difference.window_begin(bx, by, height));
                std::uint32_t sum = 0;
                for (int y = 0; y < size; ++y) {
                    for (int x = 0; x < size; ++x) {
                        const int p = a[static_cast<std::size_t>((ay + y) * width + ax + x)];
                        const int q = b[static_cast<std::size_t>((by + y) * width + bx + x)];
                        sum += difference.of(static_cast<unsigned>(std::abs(p - q)));
                    }
                }
                expected.push_back(sum);
            }
            for (const std::string& target : simd_targets()) {
                force_simd_target(target);
                std::vector<std::uint32_t> found(begins.size());
                difference.differences(rows_a.data() + difference.window_begin(ax, ay, height), rows_b.data(),
                                       begins, found.data());
                CAPTURE(size, exponent, target);
                CHECK(found == expected);
            }
        }
    }
}

TEST_CASE("the broken line is within 0.003 of the power and never falls", "[optimization]") {
    for (const double exponent : {1.0, 1.2, 1.4, 1.7, 2.0}) {
        const WindowDifference difference(14, exponent);
        CAPTURE(exponent);
        CHECK(difference.of(0) == 0);
        double worst = 0;
        for (unsigned d = 1; d < 256; ++d) {
            CHECK(difference.of(d) > difference.of(d - 1));
            worst = std::max(worst,
                             std::abs(difference.of(d) / difference.unit() - std::pow(d / 255.0, exponent)));
        }
        CHECK(worst < 0.003);
    }
}

TEST_CASE("windows without pixels or too large, and exponents beyond 1 to 2, are refused", "[optimization]") {
    CHECK_THROWS_AS(WindowDifference(0, 1.2), InputError);
    CHECK_THROWS_AS(WindowDifference(65, 1.2), InputError);
    CHECK_THROWS_AS(WindowDifference(14, 0.9), InputError);
    CHECK_THROWS_AS(WindowDifference(14, 2.1), InputError);
    CHECK_THROWS_AS(WindowDifference(14, std::nan("")), InputError);
}

}  // namespace window_difference_test
