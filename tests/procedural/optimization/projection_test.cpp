// The smoothed Heaviside projection against its formula in hyperbolic tangents.
#include "procedural/optimization/projection.h"

#include <limits>

#include "engine/base/error.h"
#include "tests/procedural/optimization/density_map_checks.h"

namespace projection_test {

using namespace lamella;
using namespace density_map_checks;

namespace {

const Values sharpnesses{0.01, 0.5, 1, 2, 4, 8, 16, 64, 500};
const Values thresholds{0, 0.1, 0.25, 0.5, 0.7, 1};

double mean_of(const Values& v, const Projection& p, const Domain& domain) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
        if (domain[i] != 0) {
            sum += projected(v[i], p);
            count += 1;
        }
    return sum / count;
}

}  // namespace

TEST_CASE("a projection has the values of the formula in hyperbolic tangents", "[optimization]") {
    for (const double b : sharpnesses)
        for (const double e : thresholds)
            for (int i = 0; i <= 50; ++i) {
                CAPTURE(b, e, i);
                const double v = i / 50.0;
                const double bottom = std::tanh(b * e) + std::tanh(b * (1 - e));
                const double top = std::tanh(b * e) + std::tanh(b * (v - e));
                REQUIRE(projected(v, {b, e}) == Approx(top / bottom).margin(1e-13));
                const double t = std::tanh(b * (v - e));
                REQUIRE(projected_slope(v, {b, e}) == Approx(b * (1 - t * t) / bottom).margin(1e-11 * b));
                if (b > 100) continue;  // sinh overflows
                const double sech = 1 / std::cosh(b * (v - e));
                const double by_threshold =
                    -b * sech * sech * std::sinh(v * b) * std::sinh((1 - v) * b) / std::sinh(b);
                REQUIRE(projected_threshold_slope(v, {b, e}) == Approx(by_threshold).margin(1e-11 * b));
            }
}

TEST_CASE("a projection keeps 0 and 1 exactly, and sharpness 0 keeps everything", "[optimization]") {
    for (const double b : sharpnesses)
        for (const double e : thresholds) {
            CHECK(projected(0, {b, e}) == 0);
            CHECK(projected(1, {b, e}) == 1);
        }
    for (int i = 0; i <= 20; ++i) CHECK(projected(i / 20.0, {0, 0.3}) == i / 20.0);
    CHECK(projected_slope(0.2, {0, 0.3}) == 1);
}

TEST_CASE("a projection rises with the value and falls with the threshold", "[optimization]") {
    for (const double b : sharpnesses) {
        for (const double e : thresholds)
            for (int i = 1; i <= 200; ++i)
                REQUIRE(projected(i / 200.0, {b, e}) >= projected((i - 1) / 200.0, {b, e}) - 1e-15);
        for (int i = 1; i <= 200; ++i)
            REQUIRE(projected(0.4, {b, i / 200.0}) <= projected(0.4, {b, (i - 1) / 200.0}) + 1e-15);
    }
    CHECK(projected(0.6, {500, 0.5}) == Approx(1));
    CHECK(projected(0.4, {500, 0.5}) == Approx(0).margin(1e-12));
}

TEST_CASE("the gradient of a projected field is that of differences", "[optimization]") {
    for (const double b : {0.5, 3.0, 12.0})
        for (const double e : {0.25, 0.5, 0.8}) {
            const Values x = random_values(70, 3, 0.01, 0.99);
            Values y(70), g(70);
            check_gradient(
                [&](const Values& v) {
                    project(v, {b, e}, y);
                    return y;
                },
                [&](const Values& weights) {
                    project_backward(x, {b, e}, weights, g);
                    return g;
                },
                x, 4);
        }
}

TEST_CASE("the threshold found keeps the volume to 1e-9 at any sharpness", "[optimization]") {
    unsigned seed = 10;
    for (const double b : {0.5, 1.0, 2.0, 8.0, 32.0, 128.0})
        for (const std::size_t n : {3UL, 50UL, 9001UL})
            for (const double mean : {0.2, 0.5, 0.77}) {
                CAPTURE(++seed, b, n, mean);
                const Values v = random_values(n, seed);
                Domain domain = random_domain(n, seed + 500);
                domain[0] = 1;
                const double most = mean_of(v, {b, 0}, domain), least = mean_of(v, {b, 1}, domain);
                const double e = volume_keeping_threshold(v, domain, b, mean);
                REQUIRE(e >= 0);
                REQUIRE(e <= 1);
                const double reachable = std::min(std::max(mean, least), most);
                REQUIRE(std::fabs(mean_of(v, {b, e}, domain) - reachable) < 1e-9);
            }
}

TEST_CASE("a projection at the threshold found has the volume of the values themselves", "[optimization]") {
    const Values v = random_values(5000, 77);
    const Domain domain(v.size(), 1);
    const double before = mean_of(v, {0, 0.5}, domain);
    for (const double b : {1.0, 4.0, 16.0, 64.0}) {
        const double e = volume_keeping_threshold(v, domain, b, before);
        CHECK(std::fabs(mean_of(v, {b, e}, domain) - before) < 1e-9);
    }
}

TEST_CASE("projections give the same bits on any number of threads", "[optimization]") {
    const Values v = random_values(50001, 5);
    const Domain domain = random_domain(v.size(), 6);
    check_same_bits([&] {
        Values out(v.size());
        const double e = volume_keeping_threshold(v, domain, 7, 0.4);
        project(v, {7, e}, out);
        out.push_back(e);
        return out;
    });
}

TEST_CASE("a projection refuses wrong sharpnesses, thresholds and domains", "[optimization]") {
    CHECK_THROWS_AS(projected(0.5, {-1, 0.5}), InputError);
    CHECK_THROWS_AS(projected(0.5, {std::numeric_limits<double>::infinity(), 0.5}), InputError);
    CHECK_THROWS_AS(projected(0.5, {1, 1.5}), InputError);
    Values out(3);
    CHECK_THROWS_AS(project(Values(4), {1, 0.5}, out), InputError);
    CHECK_THROWS_AS(volume_keeping_threshold(Values(3), Domain(3, 0), 1, 0.5), InputError);
    CHECK_THROWS_AS(volume_keeping_threshold(Values(3), Domain(3, 1), 1, 1.5), InputError);
}

}  // namespace projection_test
