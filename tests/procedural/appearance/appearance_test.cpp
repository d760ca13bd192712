// The appearance energy against its formula, and its gradient against central differences.
#include "procedural/appearance/appearance.h"

#include <catch2/catch.hpp>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "tests/procedural/appearance/synthetic_images.h"

namespace appearance_test {

using namespace lamella;
using namespace synthetic_images;

namespace {

MatchSettings settings_of(int neighbourhood, double exponent) {
    MatchSettings settings;
    settings.neighbourhood = neighbourhood;
    settings.exponent = exponent;
    return settings;
}

/// The energy by its formula, over the windows with a match.
double formula(const Appearance& appearance, const GreyImage& target) {
    const PatchMatch& field = appearance.matches();
    const int n = field.neighbourhood();
    double sum = 0;
    int windows = 0;
    for (int y = 0; y < field.windows_high(); ++y) {
        for (int x = 0; x < field.windows_across(); ++x) {
            const ExemplarPlace m = field.matches()[static_cast<std::size_t>(y * field.windows_across() + x)];
            if (m.x < 0) continue;
            ++windows;
            for (int k = 0; k < n * n; ++k) {
                const auto s = static_cast<std::size_t>((m.y + k / n) * field.exemplar_width() + m.x + k % n);
                const double d =
                    target.values[target.index(x + k % n, y + k / n)] - field.exemplar()[s] / 255.0;
                sum += std::pow(d * d + 1e-4, field.settings().exponent / 2);
            }
        }
    }
    return 100 * sum / (windows * n * n);
}

std::vector<std::uint8_t> left_part(const GreyImage& image, int columns) {
    std::vector<std::uint8_t> passive(image.values.size(), 0);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < columns; ++x) passive[image.index(x, y)] = 1;
    }
    return passive;
}

}  // namespace

TEST_CASE("the energy is that of the formula", "[optimization]") {
    const GreyImage exemplar = waves(30, 34, 1);
    for (const double exponent : {1.0, 1.2, 1.4, 2.0}) {
        for (GreyImage target : {noise(40, 28, 2), waves(40, 28, 3), cut_out(exemplar, 1, 2, 28, 28)}) {
            target.values.front() = 0;
            target.values.back() = 1;
            Appearance appearance(exemplar, target.width, target.height, settings_of(7, exponent));
            appearance.match(target.values);
            CAPTURE(exponent);
            CHECK(appearance.energy(target.values) == Approx(formula(appearance, target)).epsilon(2e-6));
        }
    }
}

TEST_CASE("the gradient agrees with central differences to a millionth while the matches stay",
          "[optimization]") {
    const GreyImage exemplar = waves(30, 34, 4);
    for (const double exponent : {1.0, 1.2, 1.4, 2.0}) {
        for (GreyImage target : {noise(24, 22, 5), waves(24, 22, 6)}) {
            target.values[0] = 0;  // at the ends of the range, too
            target.values[30] = 1;
            Appearance appearance(exemplar, 24, 22, settings_of(7, exponent), 0, left_part(target, 9));
            appearance.match(target.values);
            std::vector<double> gradient(target.values.size());
            const double energy = appearance.energy(target.values, gradient);
            CHECK(energy == appearance.energy(target.values));
            double largest = 0, worst = 0;
            for (std::size_t i = 0; i < gradient.size(); ++i) {
                constexpr double h = 2e-6;
                GreyImage more = target, less = target;
                more.values[i] += h;
                less.values[i] -= h;
                const double slope =
                    (appearance.energy(more.values) - appearance.energy(less.values)) / (2 * h);
                largest = std::max(largest, std::abs(gradient[i]));
                worst = std::max(worst, std::abs(gradient[i] - slope));
            }
            CAPTURE(exponent, largest, worst);
            CHECK(largest > 0.01);
            CHECK(worst < 1e-6 * largest);
        }
    }
}

TEST_CASE("a target cut out of the exemplar has the least energy there is", "[optimization]") {
    const GreyImage exemplar = waves(60, 50, 7), target = cut_out(exemplar, 11, 6, 40, 36);
    MatchSettings settings = settings_of(8, 1.2);
    settings.spread = 0;
    Appearance appearance(exemplar, 40, 36, settings);
    appearance.match(target.values);
    std::vector<double> gradient(target.values.size());
    const double floor = 100 * std::pow(1e-4, 0.6);
    CHECK(appearance.energy(target.values, gradient) == Approx(floor).epsilon(1e-9));
    for (const double g : gradient) CHECK(std::abs(g) < 1e-9);
}

TEST_CASE("an exemplar's own cut-out has a far lower energy than noise", "[optimization]") {
    const GreyImage exemplar = waves(60, 50, 8), own = cut_out(exemplar, 11, 6, 40, 36);
    const auto energy = [&](const GreyImage& target) {
        Appearance appearance(exemplar, 40, 36, MatchSettings{});
        appearance.match(target.values);
        return appearance.energy(target.values);
    };
    const double of_own = energy(own), of_noise = energy(noise(40, 36, 9)),
                 of_grey = energy(GreyImage(40, 36, 0.5));
    CAPTURE(of_own, of_noise, of_grey);
    CHECK(5 * of_own < of_noise);
    CHECK(5 * of_own < of_grey);
}

TEST_CASE("descent along the gradient makes grey look like the exemplar", "[optimization]") {
    const GreyImage exemplar = waves(50, 50, 10);
    GreyImage target = noise(40, 40, 11);
    for (double& v : target.values) v = 0.45 + 0.1 * v;
    Appearance appearance(exemplar, 40, 40, settings_of(8, 1.2));
    std::vector<double> gradient(target.values.size());
    double first = 0, last = 0;
    for (int k = 0; k < 60; ++k) {
        appearance.match(target.values);
        last = appearance.energy(target.values, gradient);
        if (k == 0) first = last;
        // The gradient of a pixel is about 100 / pixels times the mean slope of its terms.
        for (std::size_t i = 0; i < gradient.size(); ++i)
            target.values[i] = std::clamp(target.values[i] - 0.5 * gradient[i], 0.0, 1.0);
    }
    CAPTURE(first, last);
    CHECK(last < 0.4 * first);
}

TEST_CASE("energy and gradient have the same bits for any number of threads", "[optimization]") {
    const GreyImage exemplar = waves(40, 40, 12), target = waves(110, 90, 13);
    const auto evaluated = [&](int threads) {
        return ThreadArena(threads).execute([&] {
            Appearance appearance(exemplar, 110, 90, settings_of(8, 1.2));
            appearance.match(target.values);
            appearance.match(target.values);
            std::vector<double> numbers(target.values.size());
            const double energy = appearance.energy(target.values, numbers);
            numbers.push_back(energy);
            return numbers;
        });
    };
    const auto one = evaluated(1);
    CHECK(evaluated(2) == one);
    CHECK(evaluated(4) == one);
}

TEST_CASE("windows of passive elements only are left out of the energy", "[optimization]") {
    const GreyImage exemplar = waves(30, 30, 14), target = noise(40, 30, 15);
    Appearance appearance(exemplar, 40, 30, settings_of(7, 1.2), 0, left_part(target, 20));
    appearance.match(target.values);
    std::vector<double> gradient(target.values.size());
    const double energy = appearance.energy(target.values, gradient);
    CHECK(energy == Approx(formula(appearance, target)).epsilon(2e-6));
    // Windows reach from the other half six elements into it.
    GreyImage changed = target;
    for (int y = 0; y < 30; ++y) {
        for (int x = 0; x < 14; ++x) {
            changed.values[target.index(x, y)] = 0;
            CHECK(gradient[target.index(x, y)] == 0);
        }
        CHECK(gradient[target.index(14, y)] != 0);
    }
    CHECK(appearance.energy(changed.values) == energy);
}

TEST_CASE("the first call makes thirty sweeps and each later one makes one", "[optimization]") {
    const GreyImage exemplar = waves(30, 30, 16), target = waves(34, 34, 17);
    Appearance appearance(exemplar, 34, 34, settings_of(7, 1.2));
    PatchMatch field(exemplar, 34, 34, settings_of(7, 1.2));
    for (const int sweeps : {30, 1, 1}) {
        appearance.match(target.values);
        field.sweep(target.values, sweeps);
        CHECK(std::ranges::equal(appearance.matches().matches(), field.matches()));
    }
}

TEST_CASE("densities outside 0 to 1 and targets of another size are refused", "[optimization]") {
    const GreyImage exemplar = waves(20, 20, 18);
    const Appearance appearance(exemplar, 20, 20, settings_of(7, 1.2));
    for (const double wrong : {-0.01, 1.01, std::numeric_limits<double>::quiet_NaN()}) {
        std::vector<double> target(400, 0.5);
        target[200] = wrong;
        CHECK_THROWS_AS(appearance.energy(target), FaultError);
    }
    CHECK_THROWS_AS(appearance.energy(std::vector<double>(399, 0.5)), FaultError);
}

}  // namespace appearance_test
