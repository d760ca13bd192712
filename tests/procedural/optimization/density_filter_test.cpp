// The density filter against the double loop over all pairs of elements.
#include "procedural/optimization/density_filter.h"

#include "engine/base/error.h"
#include "tests/procedural/optimization/density_map_checks.h"

namespace density_filter_test {

using namespace lamella;
using namespace density_map_checks;

namespace {

struct Case {
    glm::ivec3 size;
    double radius;
    FilterPadding padding;
};

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const auto padding : {FilterPadding::cut, FilterPadding::mirror})
        for (const auto& [size, radius] : std::vector<std::pair<glm::ivec3, double>>{{{9, 7, 1}, 1},
                                                                                     {{9, 7, 1}, 1.5},
                                                                                     {{13, 8, 1}, 2.4},
                                                                                     {{6, 7, 5}, 2},
                                                                                     {{7, 5, 6}, 3.3},
                                                                                     {{3, 2, 4}, 7.25},
                                                                                     {{4, 3, 1}, 9.5},
                                                                                     {{1, 6, 1}, 3}})
            all.push_back({size, radius, padding});
    return all;
}

/// The places of an element along one axis: itself, and with mirrors at the borders all its images.
std::vector<int> images(int i, int size, bool mirrored) {
    if (!mirrored) return {i};
    std::vector<int> places;
    for (int period = -12; period <= 12; ++period) {
        places.push_back(i + 2 * size * period);
        places.push_back(-1 - i + 2 * size * period);
    }
    return places;
}

/// The matrix w_ij of the definition, with the domain; images of j add up.
std::vector<Values> weights(const Case& c, const Domain& domain) {
    const std::size_t n = count_of(c.size);
    std::vector<Values> w(n, Values(n, 0.0));
    const auto place = [&](std::size_t i) {
        const int k = static_cast<int>(i);
        return glm::ivec3(k % c.size.x, k / c.size.x % c.size.y, k / c.size.x / c.size.y);
    };
    const bool mirrored = c.padding == FilterPadding::mirror;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            if (domain[i] == 0 || domain[j] == 0) continue;
            const glm::ivec3 p = place(i), q = place(j);
            const auto far = [&](int a, int b) { return std::abs(a - b) >= c.radius; };
            for (const int z : images(q.z, c.size.z, mirrored && c.size.z > 1)) {
                if (far(p.z, z)) continue;
                for (const int y : images(q.y, c.size.y, mirrored)) {
                    if (far(p.y, y)) continue;
                    for (const int x : images(q.x, c.size.x, mirrored))
                        w[i][j] += std::max(0.0, c.radius - std::hypot(p.x - x, p.y - y, p.z - z));
                }
            }
        }
    return w;
}

double row_sum(const Values& row) {
    double sum = 0;
    for (const double v : row) sum += v;
    return sum;
}

void check_near(const Values& a, const Values& b) {
    REQUIRE(a.size() == b.size());
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::fabs(a[i] - b[i]));
    CHECK(worst < 1e-12);
}

}  // namespace

TEST_CASE("the density filter and its transpose are those of the double loop", "[optimization]") {
    unsigned seed = 100;
    for (const Case& c : cases()) {
        CAPTURE(++seed, c.size.x, c.size.y, c.size.z, c.radius, static_cast<int>(c.padding));
        const std::size_t n = count_of(c.size);
        const Domain domain = random_domain(n, seed);
        const Values x = random_values(n, seed + 1000), g = random_values(n, seed + 2000, -1, 1);
        const auto w = weights(c, domain);
        Values forward(n, 0.0), backward(n, 0.0), sensitivities(n, 0.0);
        for (std::size_t i = 0; i < n; ++i) {
            if (domain[i] == 0) continue;
            const double sum = row_sum(w[i]);
            for (std::size_t j = 0; j < n; ++j) {
                forward[i] += w[i][j] * x[j] / sum;
                backward[j] += w[i][j] * g[i] / sum;
                sensitivities[i] += w[i][j] * x[j] * g[j] / (sum * std::max(1e-3, x[i]));
            }
        }
        const DensityFilter filter(c.size, domain, c.radius, c.padding);
        Values out(n);
        filter.forward(x, out);
        check_near(out, forward);
        filter.backward(g, out);
        check_near(out, backward);
        filter.sensitivities(x, g, out);
        check_near(out, sensitivities);
        out = x;
        filter.forward(out, out);
        check_near(out, forward);
    }
}

TEST_CASE("the gradient of the density filter is that of differences", "[optimization]") {
    for (const Case& c :
         {Case{{9, 8, 1}, 2.7, FilterPadding::cut}, Case{{9, 8, 1}, 2.7, FilterPadding::mirror},
          Case{{5, 6, 4}, 2.2, FilterPadding::cut}, Case{{5, 6, 4}, 2.2, FilterPadding::mirror}}) {
        const std::size_t n = count_of(c.size);
        const DensityFilter filter(c.size, random_domain(n, 7), c.radius, c.padding);
        Values y(n), g(n);
        check_gradient(
            [&](const Values& x) {
                filter.forward(x, y);
                return y;
            },
            [&](const Values& weights) {
                filter.backward(weights, g);
                return g;
            },
            random_values(n, 8), 9);
    }
}

TEST_CASE("elements at an open border see void beyond it", "[optimization]") {
    // The same as in the middle of a larger grid whose domain is the small one and whose other elements are
    // 0.
    const glm::ivec3 size(9, 7, 4), around(4);
    const double radius = 3.3;
    const std::size_t n = count_of(size);
    const Values x = random_values(n, 31);
    Domain open = random_domain(n, 32);
    DensityFilter filter(size, Domain(n, 1), radius);
    Values whole(n), out(n);
    filter.forward(x, whole);
    filter.open_border(open);
    filter.forward(x, out);
    const glm::ivec3 wide = size + 2 * around;
    Values padded(count_of(wide)), far(padded.size());
    const auto place = [](glm::ivec3 p, glm::ivec3 s) {
        return static_cast<std::size_t>(p.x + s.x * (p.y + s.y * p.z));
    };
    for (std::size_t i = 0; i < n; ++i) {
        const int k = static_cast<int>(i);
        padded[place(around + glm::ivec3(k % size.x, k / size.x % size.y, k / size.x / size.y), wide)] = x[i];
    }
    DensityFilter(wide, Domain(padded.size(), 1), radius).forward(padded, far);
    for (std::size_t i = 0; i < n; ++i) {
        const int k = static_cast<int>(i);
        const std::size_t at =
            place(around + glm::ivec3(k % size.x, k / size.x % size.y, k / size.x / size.y), wide);
        CHECK(out[i] == Approx(open[i] != 0 ? far[at] : whole[i]).epsilon(1e-12));
    }
    CHECK_THROWS_AS(filter.open_border(Domain(n - 1, 1)), InputError);
}

TEST_CASE("a constant stays constant under the density filter, at borders and edges of the domain",
          "[optimization]") {
    for (const Case& c : cases()) {
        const std::size_t n = count_of(c.size);
        const Domain domain = random_domain(n, 21);
        Values out(n);
        DensityFilter(c.size, domain, c.radius, c.padding).forward(Values(n, 0.37), out);
        for (std::size_t i = 0; i < n; ++i)
            REQUIRE(out[i] == (domain[i] != 0 ? Approx(0.37).epsilon(1e-14) : Approx(0).margin(0)));
    }
}

TEST_CASE("mirrored padding keeps the sum of a full grid; cut padding does not", "[optimization]") {
    for (const glm::ivec3 size : {glm::ivec3(12, 9, 1), glm::ivec3(7, 8, 6), glm::ivec3(3, 3, 3)}) {
        const std::size_t n = count_of(size);
        const Values x = random_values(n, 31);
        const auto change = [&](FilterPadding padding) {
            Values out(n);
            DensityFilter(size, Domain(n, 1), 3.6, padding).forward(x, out);
            return std::fabs(row_sum(out) - row_sum(x));
        };
        CHECK(change(FilterPadding::mirror) < 1e-11);
        CHECK(change(FilterPadding::cut) > 1e-3);
    }
}

TEST_CASE("values outside the domain do not matter and results there are 0", "[optimization]") {
    const glm::ivec3 size(8, 7, 3);
    const std::size_t n = count_of(size);
    const Domain domain = random_domain(n, 41);
    Values x = random_values(n, 42), expected(n), out(n);
    const DensityFilter filter(size, domain, 2.5, FilterPadding::mirror);
    filter.forward(x, expected);
    for (std::size_t i = 0; i < n; ++i)
        if (domain[i] == 0) x[i] = std::nan("");
    filter.forward(x, out);
    CHECK(out == expected);
    filter.backward(x, out);
    for (std::size_t i = 0; i < n; ++i) {
        REQUIRE(std::isfinite(out[i]));
        if (domain[i] == 0) REQUIRE(out[i] == 0);
    }
}

TEST_CASE("a radius of one element filters nothing", "[optimization]") {
    const Values x = random_values(60, 51);
    Values out(60);
    DensityFilter({5, 4, 3}, Domain(60, 1), 1).forward(x, out);
    CHECK(out == x);
}

TEST_CASE("the density filter gives the same bits on any number of threads", "[optimization]") {
    const glm::ivec3 size(37, 29, 11);
    const std::size_t n = count_of(size);
    const Domain domain = random_domain(n, 61);
    const Values x = random_values(n, 62);
    check_same_bits([&] {
        const DensityFilter filter(size, domain, 3.4);
        Values forward(n), backward(n);
        filter.forward(x, forward);
        filter.backward(x, backward);
        forward.insert(forward.end(), backward.begin(), backward.end());
        return forward;
    });
}

TEST_CASE("a density filter refuses wrong radii, sizes and numbers of values", "[optimization]") {
    const Domain domain(12, 1);
    CHECK_THROWS_AS(DensityFilter({4, 3, 1}, domain, 0.99), InputError);
    CHECK_THROWS_AS(DensityFilter({4, 3, 1}, domain, 257), InputError);
    CHECK_THROWS_AS(DensityFilter({4, 3, 1}, domain, std::nan("")), InputError);
    CHECK_THROWS_AS(DensityFilter({4, 3, 2}, domain, 2), InputError);
    CHECK_THROWS_AS(DensityFilter({4, 3, 0}, {}, 2), InputError);
    Values out(12);
    CHECK_THROWS_AS(DensityFilter({4, 3, 1}, domain, 2).forward(Values(11), out), InputError);
}

}  // namespace density_filter_test
