// Least thickness from radius and thresholds, against integrals of the cone and against the worst of all
// fields.
#include "procedural/optimization/length_scale.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "engine/base/error.h"

namespace length_scale_test {

using namespace lamella;

namespace {

constexpr int half = 120;  // cells per radius

/// The cone of radius 1 about the origin, not normalised.
double cone(double x, double y, double z) { return std::max(0.0, 1 - std::sqrt(x * x + y * y + z * z)); }

/// The cone's mass in layers of cells across x, of sum 1.
std::vector<double> layer_masses(int dimensions) {
    const int cells = dimensions == 3 ? 60 : half;
    std::vector<double> masses;
    double whole = 0;
    for (int i = -cells; i <= cells; ++i) {
        double mass = 0;
        for (int j = dimensions > 1 ? -cells : 0; j <= (dimensions > 1 ? cells : 0); ++j)
            for (int k = dimensions > 2 ? -cells : 0; k <= (dimensions > 2 ? cells : 0); ++k)
                mass += cone(double(i) / cells, double(j) / cells, double(k) / cells);
        masses.push_back(mass);
        whole += mass;
    }
    for (double& m : masses) m /= whole;
    return masses;
}

/// Thickness of the thinnest surviving strip by direct sums: strips of [-s, s], values at z, both scanned in
/// steps of a hundredth of a cell with linear shares of cut cells.
double scanned_thickness(double survives, double design, int dimensions) {
    const std::vector<double> masses = layer_masses(dimensions);
    const int cells = static_cast<int>(masses.size()) / 2;
    const auto value = [&](double s, double z) {
        double sum = 0;
        for (int i = -cells; i <= cells; ++i) {
            const double low = std::max(z * cells + i - 0.5, -s * cells);
            const double high = std::min(z * cells + i + 0.5, s * cells);
            if (high > low) sum += masses[static_cast<std::size_t>(i + cells)] * (high - low);
        }
        return sum;
    };
    double s = 0, z = 0;
    while (value(s, 0) < survives) s += 0.01 / cells;
    while (value(s, z) >= design) z += 0.01 / cells;
    return 2 * z;
}

/// The largest 2 d for which variables in [0, 1] exist with v(0) = survives and mean of v(-d), v(d) <=
/// design: variables are filled in by rising ratio of what they add to the mean and to v(0).
double worst_thickness(double survives, double design, int dimensions) {
    const int span = dimensions == 2 ? half : 0;
    const auto least_mean = [&](double d) {
        std::vector<std::array<double, 2>> cells;  // ratio, what it adds to v(0)
        double whole = 0;
        for (int i = -half; i <= half; ++i)
            for (int j = -span; j <= span; ++j) {
                const double x = double(i) / half, y = double(j) / half, own = cone(x, y, 0);
                if (own <= 0) continue;
                whole += own;
                cells.push_back({0.5 * (cone(x - d, y, 0) + cone(x + d, y, 0)) / own, own});
            }
        std::sort(cells.begin(), cells.end());
        double own = 0, mean = 0;
        for (const auto& [ratio, mass] : cells) {
            const double part = std::min(mass, survives * whole - own);
            own += part;
            mean += ratio * part;
        }
        return mean / whole;
    };
    double low = 0, high = 1;
    for (int step = 0; step < 14; ++step) {
        const double d = 0.5 * (low + high);
        (least_mean(d) > design ? low : high) = d;
    }
    return low + high;
}

}  // namespace

TEST_CASE("the least thickness in one dimension is the closed form, and the radius at 3/4",
          "[optimization]") {
    CHECK(least_thickness(0.75, 0.5, 1) == Approx(1).epsilon(1e-12));
    for (const double e : {0.51, 0.55, 0.6, 0.7, 0.75})
        CHECK(least_thickness(e, 0.5, 1) == Approx(2 * std::sqrt(e - 0.5)).epsilon(1e-12));
    CHECK(least_thickness(0.5, 0.5, 1) == 0);
    CHECK(least_thickness(0.4, 0.5, 1) == 0);
}

TEST_CASE("the least thickness is that of strips filtered by sums over cells", "[optimization]") {
    for (const int dimensions : {1, 2, 3})
        for (const auto& [survives, design] :
             std::vector<std::array<double, 2>>{{0.6, 0.5}, {0.75, 0.5}, {0.9, 0.5}, {0.75, 0.4}}) {
            CAPTURE(dimensions, survives, design);
            CHECK(least_thickness(survives, design, dimensions) ==
                  Approx(scanned_thickness(survives, design, dimensions)).margin(2e-3));
        }
}

TEST_CASE(
    "no design variables at all give a thinner member than the strip: exactly in one dimension, to 3 "
    "percent in two",
    "[optimization]") {
    for (const double e : {0.6, 0.7, 0.75, 0.85}) {
        CAPTURE(e);
        const double line = least_thickness(e, 0.5, 1), plane = least_thickness(e, 0.5, 2);
        CHECK(worst_thickness(e, 0.5, 1) == Approx(line).margin(0.01));
        CHECK(worst_thickness(e, 0.5, 2) > 0.965 * plane);
        CHECK(worst_thickness(e, 0.5, 2) <= plane + 0.005);
    }
}

TEST_CASE("contours at a straight edge lie as far apart as the half space has them", "[optimization]") {
    // One dimension: v = (1 - t)^2 / 2 beyond the edge.
    CHECK(contour_distance(0.5, 0.125, 1) == Approx(0.5).epsilon(1e-12));
    CHECK(contour_distance(0.875, 0.125, 1) == Approx(1).epsilon(1e-12));
    CHECK(contour_distance(0.125, 0.5, 1) == Approx(-0.5).epsilon(1e-12));
    for (const int dimensions : {2, 3}) {
        const std::vector<double> masses = layer_masses(dimensions);
        const double cells = static_cast<double>(masses.size() / 2);
        double sum = 0, last = 0;
        std::size_t i = masses.size() / 2 + 1;
        for (sum = 0.5 + 0.5 * masses[i - 1]; sum < 0.75; ++i) sum += last = masses[i];
        const double t = (static_cast<double>(i) - 0.5 - cells - (sum - 0.75) / last) / cells;
        CHECK(contour_distance(0.75, 0.5, dimensions) == Approx(t).margin(1e-3));
    }
}

TEST_CASE("the settings keep both wanted sizes with the smallest radius", "[optimization]") {
    for (const int dimensions : {1, 2, 3})
        for (const auto& [member, gap] :
             std::vector<std::array<double, 2>>{{2, 2}, {2, 1}, {0.8, 1.5}, {1.2, 0}, {0, 3}}) {
            CAPTURE(dimensions, member, gap);
            LengthScaleWish wish;
            wish.member = member;
            wish.gap = gap;
            wish.element = 0.2;
            wish.dimensions = dimensions;
            const LengthScale s = length_scale_for(wish);
            const double radius = s.radius * wish.element;
            CHECK(radius * least_thickness(s.eroded, s.intermediate, dimensions) ==
                  Approx(member).margin(1e-9));
            CHECK(radius * least_thickness(1 - s.dilated, 1 - s.intermediate, dimensions) ==
                  Approx(gap).margin(1e-9));
            CHECK(std::max(s.eroded, 1 - s.dilated) == Approx(0.75));
            CHECK(s.intermediate == 0.5);
        }
}

TEST_CASE("sizes below the least filter are kept by thresholds nearer to 1/2", "[optimization]") {
    LengthScaleWish wish;
    wish.member = 0.5;
    wish.gap = 0.25;
    const LengthScale s = length_scale_for(wish);
    CHECK(s.radius == 1.5);
    CHECK(s.eroded < 0.75);
    CHECK(1.5 * least_thickness(s.eroded, 0.5, 3) == Approx(0.5));
    CHECK(1.5 * least_thickness(1 - s.dilated, 0.5, 3) == Approx(0.25));
}

TEST_CASE("a length scale refuses negative sizes and thresholds out of bounds", "[optimization]") {
    LengthScaleWish wish;
    wish.member = -1;
    CHECK_THROWS_AS(length_scale_for(wish), InputError);
    wish.member = std::nan("");
    CHECK_THROWS_AS(length_scale_for(wish), InputError);
    wish.member = 1;
    wish.dimensions = 4;
    CHECK_THROWS_AS(length_scale_for(wish), InputError);
    wish.dimensions = 2;
    wish.farthest = 0.5;
    CHECK_THROWS_AS(length_scale_for(wish), InputError);
    wish.farthest = 0.75;
    wish.element = 0;
    CHECK_THROWS_AS(length_scale_for(wish), InputError);
    CHECK_THROWS_AS(least_thickness(1, 0.5, 2), InputError);
}

}  // namespace length_scale_test
