// The additive manufacturing filter against its formulas, and what it lets stand.
#include "procedural/optimization/overhang_filter.h"

#include "engine/base/error.h"
#include "tests/procedural/optimization/density_map_checks.h"

namespace overhang_filter_test {

using namespace lamella;
using namespace density_map_checks;

namespace {

/// The most that the smooth minimum may add: sqrt(1e-4) / 2, and rounding.
constexpr double lift = 0.005 + 1e-12;
/// The most that remains of unsupported elements.
constexpr double faint = 0.1;

std::size_t place_in(glm::ivec3 size, glm::ivec3 p) {
    return static_cast<std::size_t>(p.x + size.x * (p.y + size.y * p.z));
}

/// Calls work(element, supports below) for the elements of the domain, layer after layer.
template <class Work>
void for_each_upward(glm::ivec3 size, const Domain& domain, int axis, const Work& work) {
    glm::ivec3 p;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (p[axis] = 0; p[axis] < size[axis]; ++p[axis])
        for (p[u] = 0; p[u] < size[u]; ++p[u])
            for (p[v] = 0; p[v] < size[v]; ++p[v]) {
                if (domain[place_in(size, p)] == 0) continue;
                std::vector<std::size_t> below;
                for (const auto& [du, dv] :
                     std::vector<std::pair<int, int>>{{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
                    glm::ivec3 q = p;
                    --q[axis];
                    q[u] += du;
                    q[v] += dv;
                    if (q[axis] < 0 || q[u] < 0 || q[v] < 0 || q[u] >= size[u] || q[v] >= size[v]) continue;
                    if (domain[place_in(size, q)] != 0) below.push_back(place_in(size, q));
                }
                work(place_in(size, p), p[axis], below);
            }
}

/// Solid if the blueprint is, and something solid is below within the cross.
Values printable(glm::ivec3 size, const Domain& domain, int axis, const Values& blueprint) {
    Values printed(blueprint.size(), 0.0);
    for_each_upward(size, domain, axis, [&](std::size_t i, int layer, const std::vector<std::size_t>& below) {
        bool supported = layer == 0;
        for (const std::size_t k : below) supported = supported || printed[k] == 1;
        if (supported) printed[i] = blueprint[i];
    });
    return printed;
}

/// The formulas of the paper, as they stand.
Values by_the_formulas(glm::ivec3 size, const Domain& domain, const OverhangSettings& s, const Values& x) {
    Values printed(x.size(), 0.0);
    int across = 0;
    for (int axis = 0; axis < 3; ++axis)
        if (axis != s.axis && size[axis] > 1) ++across;
    const double q = s.exponent + std::log(across == 2 ? 5.0 : 3.0) / std::log(s.fixed_point);
    for_each_upward(
        size, domain, s.axis, [&](std::size_t i, int layer, const std::vector<std::size_t>& below) {
            double sum = 0;
            for (const std::size_t k : below) sum += std::pow(printed[k], s.exponent);
            const double most = std::pow(sum, 1 / q), d = x[i] - most;
            printed[i] = layer == 0
                             ? x[i]
                             : 0.5 * (x[i] + most - std::sqrt(d * d + s.smoothing) + std::sqrt(s.smoothing));
        });
    return printed;
}

Values printed_by(OverhangFilter& filter, const Values& blueprint) {
    Values printed(blueprint.size());
    filter.forward(blueprint, printed);
    return printed;
}

struct Case {
    glm::ivec3 size;
    OverhangSettings settings;
};

const std::vector<Case> mixed{{{11, 9, 1}, {1}},
                              {{9, 11, 1}, {0}},
                              {{6, 5, 7}, {2}},
                              {{6, 7, 5}, {1}},
                              {{7, 5, 6}, {0}},
                              {{6, 5, 6}, {2, 12.5}},
                              {{8, 9, 1}, {1, 8, 1e-2, 0.7}}};

/// A plane of 40 x 30 elements with y upward, and what the filter prints of a blueprint there.
struct Plane {
    glm::ivec3 size{40, 30, 1};
    Values blueprint = Values(1200, 0.0);

    double& at(int x, int y) { return blueprint[place_in(size, {x, y, 0})]; }
    Values printed() const {
        OverhangFilter filter(size, Domain(1200, 1), {1});
        return printed_by(filter, blueprint);
    }
};

}  // namespace

TEST_CASE("printed densities are those of the formulas", "[optimization]") {
    unsigned seed = 200;
    for (const Case& c : mixed) {
        CAPTURE(++seed, c.settings.axis, c.settings.exponent);
        const std::size_t n = count_of(c.size);
        const Domain domain = random_domain(n, seed);
        const Values x = random_values(n, seed + 100);
        OverhangFilter filter(c.size, domain, c.settings);
        const Values printed = printed_by(filter, x),
                     expected = by_the_formulas(c.size, domain, c.settings, x);
        for (std::size_t i = 0; i < n; ++i) REQUIRE(printed[i] == Approx(expected[i]).margin(1e-12));
    }
}

TEST_CASE("the gradient of printed densities is that of differences", "[optimization]") {
    unsigned seed = 300;
    for (const Case& c : mixed) {
        CAPTURE(++seed, c.settings.axis, c.settings.exponent);
        const std::size_t n = count_of(c.size);
        OverhangFilter filter(c.size, random_domain(n, seed), c.settings);
        check_gradient([&](const Values& x) { return printed_by(filter, x); },
                       [&](const Values& weights) {
                           Values g(n);
                           filter.backward(weights, g);
                           return g;
                       },
                       random_values(n, seed + 100, 0.05, 0.95), seed + 200);
    }
}

TEST_CASE("solid is printed if and only if something solid is below within the cross", "[optimization]") {
    unsigned seed = 400;
    for (const auto& [size, axis] : std::vector<std::pair<glm::ivec3, int>>{
             {{40, 30, 1}, 1}, {{30, 40, 1}, 0}, {{12, 13, 14}, 2}, {{14, 12, 13}, 0}, {{12, 14, 13}, 1}})
        for (const double share : {0.3, 0.5, 0.7}) {
            CAPTURE(++seed, axis, share);
            const std::size_t n = count_of(size);
            const Domain domain = random_domain(n, seed);
            Values blueprint = random_values(n, seed + 100);
            for (double& v : blueprint) v = v < share ? 1 : 0;
            OverhangFilter filter(size, domain, {axis});
            const Values printed = printed_by(filter, blueprint);
            const Values expected = printable(size, domain, axis, blueprint);
            int stopped = 0;
            for (std::size_t i = 0; i < n; ++i) {
                CAPTURE(i, printed[i], expected[i], blueprint[i]);
                if (domain[i] == 0) {
                    REQUIRE(printed[i] == 0);
                } else if (expected[i] == 1) {
                    REQUIRE(printed[i] >= 1 - 1e-12);
                    REQUIRE(printed[i] <= 1 + lift);
                } else if (blueprint[i] == 0) {
                    REQUIRE(printed[i] <= lift);
                } else {
                    REQUIRE(printed[i] <= faint);
                    ++stopped;
                }
            }
            if (share < 0.6) CHECK(stopped > 0);
        }
}

TEST_CASE("a printed density is at most its blueprint and the lift of the smooth minimum", "[optimization]") {
    for (const Case& c : mixed) {
        const std::size_t n = count_of(c.size);
        OverhangFilter filter(c.size, random_domain(n, 501), c.settings);
        const Values x = random_values(n, 502), printed = printed_by(filter, x);
        for (std::size_t i = 0; i < n; ++i) {
            REQUIRE(printed[i] >= 0);
            REQUIRE(printed[i] <= x[i] + 0.5 * std::sqrt(c.settings.smoothing) + 1e-12);
        }
    }
}

TEST_CASE("a bar at 45 degrees stands; one that leans farther ends where it leaves the plate",
          "[optimization]") {
    Plane steep, shallow;
    for (int y = 0; y < 20; ++y) {
        steep.at(3 + y, y) = 1;  // one element thick: each rests on the corner of the one below
        for (int x = 2 * y; x < 2 * y + 2; ++x) shallow.at(x, y) = 1;
    }
    const Values stands = steep.printed(), falls = shallow.printed();
    for (int y = 0; y < 20; ++y) CHECK(stands[place_in(steep.size, {3 + y, y, 0})] >= 1 - 1e-12);
    // Two elements a layer: the first of each rests on the last below, the second on nothing.
    CHECK(falls[place_in(shallow.size, {2, 1, 0})] >= 1 - 1e-12);
    CHECK(falls[place_in(shallow.size, {3, 1, 0})] <= faint);
    for (int y = 2; y < 20; ++y)
        for (int x = 0; x < 40; ++x) CHECK(falls[place_in(shallow.size, {x, y, 0})] <= faint);
}

TEST_CASE("a floating block vanishes, however high; the same block on a column opens by 45 degrees",
          "[optimization]") {
    Plane floating, mushroom;
    for (int y = 5; y < 30; ++y)
        for (int x = 0; x < 40; ++x) floating.at(x, y) = mushroom.at(x, y) = 1;
    for (int y = 0; y < 5; ++y) mushroom.at(20, y) = 1;
    for (const double p : floating.printed()) CHECK(p <= faint);
    const Values opened = mushroom.printed();
    for (int y = 5; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            const double p = opened[place_in(mushroom.size, {x, y, 0})];
            if (std::abs(x - 20) <= y - 4)
                CHECK(p >= 1 - 1e-12);
            else
                CHECK(p <= faint);
        }
    // In three dimensions, too.
    const glm::ivec3 size(15, 15, 40);
    Values block(count_of(size), 1.0);
    for (int i = 0; i < 15 * 15 * 2; ++i) block[static_cast<std::size_t>(i)] = 0;
    OverhangFilter filter(size, Domain(block.size(), 1), {2});
    for (const double p : printed_by(filter, block)) REQUIRE(p <= faint);
}

TEST_CASE("a density at the fixed point passes up a full block unchanged", "[optimization]") {
    // Equal supports of 1/2 allow 1/2; solid elements on them become 1/2 and the lift of one minimum.
    const glm::ivec3 size(9, 9, 2);
    Values x(162, 1.0);
    for (std::size_t i = 0; i < 81; ++i) x[i] = 0.5;
    OverhangFilter filter(size, Domain(162, 1), {2});
    const double expected = 0.5 * (1 + 0.5 - std::sqrt(0.25 + 1e-4) + 1e-2);
    CHECK(printed_by(filter, x)[place_in(size, {4, 4, 1})] == Approx(expected).epsilon(1e-13));
}

TEST_CASE("the plate supports the lowest layer of the grid, and not the body's own lowest layer above it",
          "[optimization]") {
    const glm::ivec3 size(6, 6, 1);
    Domain domain(36, 1);
    for (std::size_t x = 3; x < 6; ++x) domain[x] = 0;  // under the right half is nothing
    OverhangFilter filter(size, domain, {1});
    const Values x = random_values(36, 11), printed = printed_by(filter, x);
    for (std::size_t i = 0; i < 3; ++i) CHECK(printed[i] == x[i]);
    CHECK(printed[6 + 5] <= lift);
    Values g(36);
    filter.backward(Values(36, 1.0), g);
    for (std::size_t i = 3; i < 6; ++i) CHECK(g[i] == 0);
}

TEST_CASE("the overhang filter gives the same bits on any number of threads", "[optimization]") {
    const glm::ivec3 size(23, 31, 9);
    const std::size_t n = count_of(size);
    const Domain domain = random_domain(n, 71);
    const Values x = random_values(n, 72), weights = random_values(n, 73, -1, 1);
    check_same_bits([&] {
        OverhangFilter filter(size, domain, {2, 17.5});
        Values all = printed_by(filter, x), g(n);
        filter.backward(weights, g);
        all.insert(all.end(), g.begin(), g.end());
        return all;
    });
}

TEST_CASE("the overhang filter refuses wrong settings and a gradient before the densities",
          "[optimization]") {
    const Domain domain(12, 1);
    CHECK_THROWS_AS(OverhangFilter({4, 3, 1}, domain, {3}), InputError);
    CHECK_THROWS_AS(OverhangFilter({4, 3, 1}, domain, {1, 3}), InputError);
    CHECK_THROWS_AS(OverhangFilter({4, 3, 1}, domain, {1, 40, 0}), InputError);
    CHECK_THROWS_AS(OverhangFilter({4, 3, 1}, domain, {1, 40, 1e-4, 1}), InputError);
    CHECK_THROWS_AS(OverhangFilter({4, 3, 1}, domain, {1, 4, 1e-4, 0.9}), InputError);
    OverhangFilter filter({4, 3, 1}, domain, {1});
    Values out(12);
    CHECK_THROWS_AS(filter.backward(out, out), FaultError);
    CHECK_THROWS_AS(filter.forward(Values(5), out), InputError);
}

}  // namespace overhang_filter_test
