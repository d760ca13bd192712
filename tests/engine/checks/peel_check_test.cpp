// The peel check against closed forms of simple parts, and against maximum flows through random voxels.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <queue>
#include <random>

#include "engine/checks/print_check.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/surveys/island_scenes.h"

namespace peel_check_test {

using namespace lamella;

namespace {

constexpr double h = 0.2, pitch = 0.05, pi = 3.14159265358979;

CheckReport check(const FieldPtr& part, double limit, const FieldPtr& supports = nullptr,
                  double rows_apart = pitch, double layer_height = h) {
    PrintCheckOptions options;
    options.limits.verdicts[static_cast<std::size_t>(Check::peel)] = Severity::warn;
    options.limits.peel = limit;
    options.pitch = rows_apart;
    Job job = scenes::job_of(part, part->bounds(), layer_height);
    job.supports = supports;
    PrintCheck checks(job, options);
    survey_layers(job, checks, {});
    return checks.report();
}

FieldPtr box(dvec3 lo, dvec3 hi) { return make_box({lo, hi}); }

/// A leg of a square section, from the bed up to 6 mm.
FieldPtr leg(double x, double y, double side) { return box({x, y, 0}, {x + side, y + side, 6.1}); }

/// A plate of 20 x 20 mm on legs.
FieldPtr table(std::vector<FieldPtr> legs) {
    legs.push_back(box({0, 0, 6}, {20, 20, 8}));
    return make_union(legs);
}

/// The one fault, which is found below 0.9 of its factor and not above the factor itself.
Fault the_fault(const FieldPtr& part, double factor, const FieldPtr& supports = nullptr) {
    CHECK(check(part, factor, supports).results.front().passed());
    const CheckReport report = check(part, 0.9 * factor, supports);
    REQUIRE(report.results.size() == 1);
    REQUIRE(report.results.front().count == 1);
    const Fault& fault = report.results.front().worst.front();
    CHECK(fault.size <= factor);
    CHECK(fault.size > 0.93 * factor);
    CHECK(*std::ranges::max_element(report.peel->load.values()) == fault.size);
    return fault;
}

}  // namespace

TEST_CASE("a plate hangs by the leg below it", "[check][peel]") {
    const Fault fault = the_fault(table({leg(9, 9, 2)}), 400.0 / 4);
    CHECK(fault.at.x == Approx(10).margin(0.1));
    CHECK(fault.at.y == Approx(10).margin(0.1));
    CHECK(fault.layer == 0);
    CHECK(fault.end_layer == 40);
}

TEST_CASE("legs share what a plate pulls at", "[check][peel]") {
    the_fault(table({leg(0, 0, 1), leg(19, 0, 1), leg(9, 9, 2)}), 400.0 / 6);
    // A leg that ends above the bed holds nothing.
    the_fault(table({leg(0, 0, 1), leg(19, 0, 1), leg(9, 9, 2), box({5, 5, 3}, {8, 8, 6.1})}), 400.0 / 6);
}

TEST_CASE("the smallest section of a leg counts", "[check][peel]") {
    const FieldPtr thin = box({9.5, 9.5, 0}, {10.5, 10.5, 6.1});
    const FieldPtr waist = make_union({box({9, 9, 0}, {11, 11, 3}), box({9, 9, 4}, {11, 11, 6.1}), thin});
    const Fault fault = the_fault(table({waist}), 400);
    CHECK(fault.at.z == Approx(3.1));
    CHECK(fault.box.size().x == Approx(1).margin(pitch));
}

TEST_CASE("a branch hangs by its own root", "[check][peel]") {
    // The block holds all of it easily, the root of the bracket does not.
    const FieldPtr part = make_union({box({0, 0, 0}, {20, 20, 2}), box({2, 2, 2}, {3, 3, 4}),
                                      box({2, 2, 4}, {12, 12, 6}), box({15, 0, 2}, {20, 20, 6})});
    const Fault fault = the_fault(part, 100);
    CHECK(fault.at.z == Approx(2.1));
}

TEST_CASE("a ball stands on the cap that touches the bed", "[check][peel]") {
    // Layers of 0.05 mm: the first cuts the ball a quarter of a tenth over the bed.
    constexpr double radius = 8, z = 0.025;
    const double cap = pi * (2 * radius * z - z * z);
    const CheckReport report = check(make_sphere({0, 0, radius}, radius), 60, nullptr, pitch, 2 * z);
    REQUIRE(report.results.front().count == 1);
    const double factor = pi * radius * radius / cap;
    CHECK(report.results.front().worst.front().size < factor);
    CHECK(report.results.front().worst.front().size > 0.9 * factor);
}

TEST_CASE("supports hold what is peeled off", "[check][peel]") {
    const FieldPtr plate = box({0, 0, 6}, {20, 20, 8});
    const FieldPtr part = make_union({plate, box({9, 9, 0}, {11, 11, 6.1})});
    the_fault(part, 400.0 / 4);
    the_fault(part, 400.0 / 8, make_union({leg(0, 0, 1), leg(19, 0, 1), leg(0, 19, 1), leg(19, 19, 1)}));
}

TEST_CASE("the curve holds the area of every layer, also of very many", "[check][peel]") {
    constexpr double radius = 5;
    const FieldPtr ball = make_sphere({0, 0, radius}, radius);
    for (const double height : {0.1, 0.004}) {
        const CheckReport report = check(ball, 60, nullptr, 0.1, height);
        const LayerCurve& area = report.peel->area;
        CHECK(area.layers_each() == (height < 0.01 ? 4 : 1));
        const auto layers = static_cast<std::size_t>(std::lround(2 * radius / height));
        const auto each = static_cast<std::size_t>(area.layers_each());
        REQUIRE(area.values().size() == (layers + each - 1) / each);
        for (std::size_t i = 0; i < area.values().size(); ++i) {
            double greatest = 0;
            for (std::size_t k = i * each; k < std::min((i + 1) * each, layers); ++k) {
                const double z = (static_cast<double>(k) + 0.5) * height - radius;
                greatest = std::max(greatest, pi * (radius * radius - z * z));
            }
            CHECK(area.values()[i] == Approx(greatest).epsilon(0.01).margin(0.05));
        }
    }
}

namespace {

/// A part of unit cubes.
struct Voxels {
    static constexpr int side = 7;
    std::vector<std::array<std::array<bool, side>, side>> layers;

    bool at(int k, int y, int x) const {
        if (y < 0 || x < 0 || y >= side || x >= side) return false;
        return layers[static_cast<std::size_t>(k)][static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
    }
};

/// Layers that change at a few places each.
Voxels random_voxels(std::mt19937& random) {
    Voxels voxels;
    voxels.layers.resize(7);
    for (std::size_t k = 0; k < voxels.layers.size(); ++k) {
        for (std::size_t y = 0; y < Voxels::side; ++y) {
            for (std::size_t x = 0; x < Voxels::side; ++x) {
                const bool below = k > 0 && voxels.layers[k - 1][y][x];
                voxels.layers[k][y][x] = random() % 100 < (k == 0 ? 45U : below ? 70U : 20U);
            }
        }
    }
    return voxels;
}

FieldPtr field_of(const Voxels& voxels) {
    // Two posts span the bounds; they lie apart and pull as little as they hold.
    std::vector<FieldPtr> cubes{box({-3, -3, 0}, {-2, -2, 7}), box({9, 9, 0}, {10, 10, 7})};
    for (int k = 0; k < static_cast<int>(voxels.layers.size()); ++k)
        for (int y = 0; y < Voxels::side; ++y)
            for (int x = 0; x < Voxels::side; ++x)
                if (voxels.at(k, y, x)) cubes.push_back(box({x, y, k}, {x + 1, y + 1, k + 1}));
    return make_union(cubes);
}

/// The connected components of all layers and their contacts, as a network with the bed as node 0.
struct Network {
    struct Component {
        int layer;
        int area;
    };
    std::vector<Component> components{{-1, 0}};
    std::vector<std::vector<int>> capacity;

    explicit Network(const Voxels& voxels) {
        std::vector<std::array<std::array<int, Voxels::side>, Voxels::side>> labels(voxels.layers.size());
        for (int k = 0; k < static_cast<int>(voxels.layers.size()); ++k) {
            auto& label = labels[static_cast<std::size_t>(k)];
            for (auto& row : label) row.fill(0);
            for (int y = 0; y < Voxels::side; ++y)
                for (int x = 0; x < Voxels::side; ++x) fill(voxels, label, k, y, x);
        }
        capacity.assign(components.size(), std::vector<int>(components.size(), 0));
        for (std::size_t k = 0; k < labels.size(); ++k) {
            for (std::size_t y = 0; y < Voxels::side; ++y) {
                for (std::size_t x = 0; x < Voxels::side; ++x) {
                    const int above = labels[k][y][x], below = k == 0 ? 0 : labels[k - 1][y][x];
                    if (above == 0 || (k > 0 && below == 0)) continue;
                    ++capacity[static_cast<std::size_t>(above)][static_cast<std::size_t>(below)];
                    ++capacity[static_cast<std::size_t>(below)][static_cast<std::size_t>(above)];
                }
            }
        }
    }

    template <typename Labels>
    void fill(const Voxels& voxels, Labels& label, int k, int y, int x) {
        const auto seen = [&](int b, int a) -> int& {
            return label[static_cast<std::size_t>(b)][static_cast<std::size_t>(a)];
        };
        if (!voxels.at(k, y, x) || seen(y, x) != 0) return;
        const int number = static_cast<int>(components.size());
        components.push_back({k, 0});
        std::vector<std::pair<int, int>> open{{y, x}};
        seen(y, x) = number;
        while (!open.empty()) {
            const auto [b, a] = open.back();
            open.pop_back();
            ++components.back().area;
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    if (!voxels.at(k, b + dy, a + dx) || seen(b + dy, a + dx) != 0) continue;
                    seen(b + dy, a + dx) = number;
                    open.emplace_back(b + dy, a + dx);
                }
            }
        }
    }

    /// The largest flow from some components to the bed through layers up to theirs (Edmonds and Karp).
    int flow(const std::vector<int>& sources, int layer) const {
        std::vector<std::vector<int>> left = capacity;
        int total = 0;
        while (true) {
            std::vector<int> from(components.size(), -1);
            std::queue<int> open;
            for (const int source : sources) {
                from[static_cast<std::size_t>(source)] = source;
                open.push(source);
            }
            while (!open.empty() && from[0] < 0) {
                const auto node = static_cast<std::size_t>(open.front());
                open.pop();
                for (std::size_t to = 0; to < components.size(); ++to) {
                    if (from[to] >= 0 || left[node][to] <= 0 || components[to].layer > layer) continue;
                    from[to] = static_cast<int>(node);
                    open.push(static_cast<int>(to));
                }
            }
            if (from[0] < 0) return total;
            for (int node = 0; from[static_cast<std::size_t>(node)] != node;) {
                const int before = from[static_cast<std::size_t>(node)];
                --left[static_cast<std::size_t>(before)][static_cast<std::size_t>(node)];
                ++left[static_cast<std::size_t>(node)][static_cast<std::size_t>(before)];
                node = before;
            }
            ++total;
        }
    }

    /// The greatest factor by which one component, or all that are connected below, pull at what holds them.
    double factor(int layer) const {
        std::vector<int> piece(components.size());
        std::iota(piece.begin(), piece.end(), 0);
        for (std::size_t rounds = 0; rounds < components.size(); ++rounds)
            for (std::size_t a = 1; a < components.size(); ++a)
                for (std::size_t b = 1; b < components.size(); ++b)
                    if (capacity[a][b] > 0 && components[a].layer <= layer && components[b].layer <= layer)
                        piece[a] = piece[b] = std::min(piece[a], piece[b]);
        double greatest = 0;
        std::vector<std::vector<int>> groups(components.size());
        const auto pull = [&](const std::vector<int>& sources) {
            int area = 0;
            for (const int source : sources) area += components[static_cast<std::size_t>(source)].area;
            const int held = sources.empty() ? 0 : flow(sources, layer);
            if (held > 0) greatest = std::max(greatest, static_cast<double>(area) / held);
        };
        for (std::size_t c = 1; c < components.size(); ++c) {
            if (components[c].layer != layer) continue;
            groups[static_cast<std::size_t>(piece[c])].push_back(static_cast<int>(c));
            pull({static_cast<int>(c)});
        }
        for (const std::vector<int>& group : groups) pull(group);
        return greatest;
    }
};

}  // namespace

TEST_CASE("no section is called more stressed than the largest flow through random voxels leaves it",
          "[check][peel]") {
    std::mt19937 random(7);
    int layers = 0, exact = 0;
    for (int round = 0; round < 60; ++round) {
        const Voxels voxels = random_voxels(random);
        const Network network(voxels);
        const CheckReport report = check(field_of(voxels), 1e6, nullptr, 0.05, 1);
        REQUIRE(report.peel->load.values().size() == voxels.layers.size());
        for (int k = 0; k < static_cast<int>(voxels.layers.size()); ++k) {
            const double load = report.peel->load.values()[static_cast<std::size_t>(k)];
            const double factor = std::max(network.factor(k), 1.0);  // the posts'
            INFO("round " << round << " layer " << k);
            CHECK(load <= factor * (1 + 1e-9));
            ++layers;
            exact += load > 0.9 * factor ? 1 : 0;
        }
    }
    CHECK(exact > 0.8 * layers);
}

}  // namespace peel_check_test
