// Triply periodic solids: runs against the library's sines, walls and struts of the promised thickness.
#include "procedural/lattice/tpms.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "procedural/lattice/tpms_surface.h"
#include "tests/engine/field/gradings.h"
#include "tests/procedural/grading/grading_checks.h"

namespace tpms_test {

using namespace lamella;

namespace {

constexpr TpmsKind kinds[] = {TpmsKind::gyroid, TpmsKind::schwarz_p, TpmsKind::schwarz_d, TpmsKind::neovius};

/// g by its definition and the library's sines.
double defined_g(TpmsKind kind, dvec3 u) {
    const dvec3 s(std::sin(u.x), std::sin(u.y), std::sin(u.z)),
        c(std::cos(u.x), std::cos(u.y), std::cos(u.z));
    switch (kind) {
        case TpmsKind::gyroid:
            return s.x * c.y + s.y * c.z + s.z * c.x;
        case TpmsKind::schwarz_p:
            return c.x + c.y + c.z;
        case TpmsKind::schwarz_d:
            return s.x * s.y * s.z + s.x * c.y * c.z + c.x * s.y * c.z + c.x * c.y * s.z;
        case TpmsKind::neovius:
            break;
    }
    return 3 * (c.x + c.y + c.z) + 4 * c.x * c.y * c.z;
}

/// The levels that the header promises.
Interval defined_levels(TpmsKind kind, bool network, double thickness_in_periods) {
    const double root_3 = std::sqrt(3.0);
    const double on_surface = kind == TpmsKind::neovius ? 3 * root_3 : root_3;
    const double anywhere = kind == TpmsKind::neovius ? 7 : root_3;
    const double joined = kind == TpmsKind::gyroid ? -std::sqrt(2.0) : kind == TpmsKind::neovius ? -0.75 : -1;
    const double t = pi * thickness_in_periods;
    if (network) return {-infinity, joined + anywhere * t};
    return {-on_surface * t, on_surface * t};
}

TpmsSettings settings(TpmsKind kind, bool network, double period, double thickness, Box region) {
    TpmsSettings s;
    s.kind = kind;
    s.network = network;
    s.period = make_constant_grading(period);
    s.thickness = make_constant_grading(thickness);
    s.region = region;
    return s;
}

RowBand band_over(const Box& region, Axis axis, double pitch) {
    const bool rows = axis == Axis::x;
    RowBand band{axis, rows ? region.lo.x : region.lo.y, pitch, rows ? region.lo.y : region.lo.x, pitch};
    band.hi = static_cast<int>(std::ceil((rows ? region.size().x : region.size().y) / pitch));
    band.count = static_cast<int>((rows ? region.size().y : region.size().x) / pitch);
    return band;
}

RunRows runs_of(const Field& field, const RowBand& band, double z) {
    SliceContext context;
    Scratch scratch;
    RunRows rows;
    context.slice(field, z).runs(band, scratch, rows);
    return rows;
}

dvec3 position(const RowBand& band, double u, int line, double z) {
    const double along = band.along(u), across = band.line(line);
    return band.axis == Axis::x ? dvec3(along, across, z) : dvec3(across, along, z);
}

/// Whether the points of one period with g < level are in one piece that runs through to the next period in
/// every direction.
bool hangs_together(TpmsKind kind, double level) {
    constexpr int n = 48, turns = 2 * n;  // two periods along each side, wrapped
    std::vector<char> solid(turns * turns * turns);
    const auto index = [](int x, int y, int z) {
        const auto wrap = [](int i) { return (i + turns) % turns; };
        return static_cast<std::size_t>((wrap(z) * turns + wrap(y)) * turns + wrap(x));
    };
    for (int z = 0; z < turns; ++z) {
        for (int y = 0; y < turns; ++y) {
            for (int x = 0; x < turns; ++x) {
                solid[index(x, y, z)] = defined_g(kind, dvec3(x, y, z) * (2 * pi / n)) < level;
            }
        }
    }
    // The deepest point and its copy one period on: joined within two wrapped periods only by struts.
    std::size_t deepest = 0;
    double least = infinity;
    for (int i = 0; i < n * n * n; ++i) {
        const double g = defined_g(kind, dvec3(i % n, i / n % n, i / n / n) * (2 * pi / n));
        if (g < least) {
            least = g;
            deepest = index(i % n, i / n % n, i / n / n);
        }
    }
    std::vector<std::size_t> open{deepest};
    solid[deepest] = 2;
    while (!open.empty()) {
        const auto i = static_cast<int>(open.back());
        open.pop_back();
        const int x = i % turns, y = i / turns % turns, z = i / turns / turns;
        for (const auto& d : {glm::ivec3(1, 0, 0), glm::ivec3(-1, 0, 0), glm::ivec3(0, 1, 0),
                              glm::ivec3(0, -1, 0), glm::ivec3(0, 0, 1), glm::ivec3(0, 0, -1)}) {
            const std::size_t next = index(x + d.x, y + d.y, z + d.z);
            if (solid[next] != 1) continue;
            solid[next] = 2;
            open.push_back(next);
        }
    }
    const auto x = static_cast<int>(deepest) % turns, y = static_cast<int>(deepest) / turns % turns,
               z = static_cast<int>(deepest) / turns / turns;
    return solid[index(x + n, y, z)] == 2 && solid[index(x, y + n, z)] == 2 && solid[index(x, y, z + n)] == 2;
}

/// Whether values asked for together are those asked for one by one, to the last bit.
void check_values(const Field& field, const Box& box) {
    std::mt19937 random(3);
    std::vector<dvec3> points;
    for (int i = 0; i < 101; ++i) points.push_back(checks::random_point(random, box));
    std::vector<double> together(points.size());
    field.values(points, together);
    for (std::size_t i = 0; i < points.size(); ++i) CHECK(together[i] == field.value(points[i]));
}

}  // namespace

TEST_CASE("the constants of the surfaces are those of their definitions", "[tpms]") {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> angle(0, 2 * pi);
    for (const TpmsKind kind : kinds) {
        INFO("kind " << static_cast<int>(kind));
        const TpmsConstants constants = tpms_constants(kind);
        double steepest = 0, steepest_along = 0, steepest_surface = 0, greatest = 0;
        const auto look = [&](dvec3 u) {
            dvec3 gradient(0);
            for (int i = 0; i < 3; ++i) {
                dvec3 e(0);
                e[i] = 1e-5;
                gradient[i] = (defined_g(kind, u + e) - defined_g(kind, u - e)) / 2e-5;
            }
            const double g = defined_g(kind, u), steep = glm::length(gradient);
            greatest = std::max(greatest, std::abs(g));
            for (int i = 0; i < 3; ++i) steepest_along = std::max(steepest_along, std::abs(gradient[i]));
            steepest = std::max(steepest, steep);
            if (std::abs(g) < 1e-3) steepest_surface = std::max(steepest_surface, steep);
        };
        for (int i = 0; i < 200000; ++i) look({angle(random), angle(random), angle(random)});
        for (int i = 0; i < 8 * 8 * 8; ++i) look(dvec3(i % 8, i / 8 % 8, i / 64) * (pi / 4));
        CHECK(greatest == Approx(constants.greatest).epsilon(0.001));
        CHECK(steepest == Approx(constants.steepest).epsilon(1e-6));
        CHECK(steepest_surface == Approx(constants.steepest_surface).epsilon(1e-3));
        CHECK(greatest <= constants.greatest + 1e-12);
        CHECK(steepest <= constants.steepest + 1e-6);
        CHECK(steepest_along == Approx(constants.steepest_along).epsilon(1e-3));
        CHECK(steepest_along <= constants.steepest_along + 1e-6);
        CHECK(hangs_together(kind, constants.joined + 0.02 * constants.greatest));
        CHECK_FALSE(hangs_together(kind, constants.joined - 0.02 * constants.greatest));
    }
}

TEST_CASE("runs end where g reaches its levels, along rows and columns", "[tpms]") {
    const double period = 2.3, z = 0.71;
    const Box region{{-3, -4, -1}, {6, 5, 3}};
    const dvec3 center = region.center();
    for (const TpmsKind kind : kinds) {
        for (const bool network : {false, true}) {
            for (const double share : {0.03, 0.11, 0.24}) {
                for (const Axis axis : {Axis::x, Axis::y}) {
                    INFO("kind " << static_cast<int>(kind) << (network ? ", network" : ", sheet")
                                 << ", share " << share << (axis == Axis::x ? ", rows" : ", columns"));
                    const auto field = make_tpms(settings(kind, network, period, share * period, region));
                    const Interval levels = defined_levels(kind, network, share);
                    const RowBand band = band_over(region, axis, 0.05);
                    const RunRows rows = runs_of(*field, band, z);
                    const auto g = [&](double u, int line) {
                        return defined_g(kind, (position(band, u, line, z) - center) * (2 * pi / period));
                    };
                    const auto solid = [&](double u, int line) {
                        return levels.lo < g(u, line) && g(u, line) < levels.hi;
                    };
                    std::size_t ends = 0;
                    for (int l = 0; l < band.lines(); l += 7) {
                        std::vector<bool> inside(static_cast<std::size_t>(band.hi) * run_unit);
                        for (const Run& run : rows.line(static_cast<std::size_t>(l))) {
                            for (int u = run.begin; u < run.end; ++u)
                                inside[static_cast<std::size_t>(u)] = true;
                            ends += 2;
                        }
                        for (int u = 0; u < band.hi * run_unit; u += 5) {
                            const bool in = inside[static_cast<std::size_t>(u)];
                            // A unit that holds an end may fall to either side.
                            if (solid(u, l) == solid(u + 1, l)) REQUIRE(in == solid(u + 0.5, l));
                        }
                    }
                    CHECK(ends > 40);
                }
            }
        }
    }
}

TEST_CASE("a wall holds half its thickness on either side of its middle", "[tpms]") {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> place(-4, 4);
    std::normal_distribution<double> normal;
    for (const TpmsKind kind : kinds) {
        INFO("kind " << static_cast<int>(kind));
        // The Neovius surface keeps its promise to first order only: a thin wall.
        const double thickness = kind == TpmsKind::neovius ? 0.02 : 0.5;
        const auto field = make_tpms(settings(kind, false, 3, thickness, {dvec3(-5), dvec3(5)}));
        int found = 0;
        while (found < 300) {
            dvec3 a(place(random), place(random), place(random)), b = a + dvec3(0, 0, 0.3);
            const auto g = [&](dvec3 p) { return defined_g(kind, p * (2 * pi / 3)); };
            if ((g(a) < 0) == (g(b) < 0)) continue;
            ++found;
            for (int i = 0; i < 60; ++i) {
                const dvec3 m = (a + b) * 0.5;
                ((g(m) < 0) == (g(a) < 0) ? a : b) = m;
            }
            for (int k = 0; k < 40; ++k) {
                const dvec3 way = glm::normalize(dvec3(normal(random), normal(random), normal(random)));
                REQUIRE(field->value(a + way * (thickness * 0.499)) < 0);
            }
        }
        CHECK(field->metric() == Metric::bound);
    }
}

TEST_CASE("the neck of a Schwarz P network has the thickness asked for", "[tpms]") {
    const double period = 4;
    for (const double thickness : {0.1, 0.4, 1.0}) {
        const auto field =
            make_tpms(settings(TpmsKind::schwarz_p, true, period, thickness, {dvec3(-8), dvec3(8)}));
        // Struts lie along x through (0, P/2, P/2), narrowest at x = 0.
        for (int k = 0; k < 64; ++k) {
            const double t = 2 * pi * k / 64;
            const dvec3 axis(0, period / 2, period / 2), way(0, std::cos(t), std::sin(t));
            REQUIRE(field->value(axis + way * (thickness * 0.4999)) < 0);
        }
        CHECK(field->value({0, 0, 0}) > 0);
    }
}

TEST_CASE("a solid with one graded number has the runs of its definition", "[tpms]") {
    const Box region{{-4, -3, -2}, {4, 3, 2}};
    for (const bool graded_period : {false, true}) {
        for (const bool network : {false, true}) {
            for (const TpmsKind kind : kinds) {
                INFO("kind " << static_cast<int>(kind) << (network ? ", network" : ", sheet")
                             << (graded_period ? ", period" : ", thickness"));
                TpmsSettings s = settings(kind, network, 2.5, 0.3, region);
                if (graded_period) {
                    s.period = std::make_shared<Linear>(2.5, dvec3(0.1, 0.05, -0.1));
                } else {
                    s.thickness = std::make_shared<Linear>(0.3, dvec3(0.05, 0.02, 0));
                }
                const auto field = make_tpms(s);
                CHECK(field->metric() == Metric::sign);
                check_values(*field, region);
                const double z = -0.43, pitch = 0.08;
                for (const Axis axis : {Axis::x, Axis::y}) {
                    const RowBand band = band_over(region, axis, pitch);
                    const RunRows rows = runs_of(*field, band, z);
                    const auto solid = [&](double u, int l) {
                        const dvec3 p = position(band, u, l, z);
                        const double period = s.period->at(p);
                        const double g = defined_g(kind, (p - region.center()) * (2 * pi / period));
                        const Interval levels = defined_levels(kind, network, s.thickness->at(p) / period);
                        return levels.lo < g && g < levels.hi;
                    };
                    for (int l = 0; l < band.lines(); l += 5) {
                        const auto line = rows.line(static_cast<std::size_t>(l));
                        for (int u = 64; u < band.hi * run_unit - 64; u += 97) {
                            // Slivers under a quarter pitch need not be seen.
                            bool plain = true;
                            for (int k = -64; k <= 64; k += 2) plain &= solid(u + k, l) == solid(u, l);
                            if (!plain) continue;
                            bool in = false;
                            for (const Run& run : line) in |= run.begin <= u && u < run.end;
                            REQUIRE(in == solid(u, l));
                        }
                    }
                }
            }
        }
    }
}

TEST_CASE("a periodic solid out of range is refused", "[tpms]") {
    const Box region{dvec3(0), dvec3(10)};
    const auto with = [&](double period, double thickness, bool network = false) {
        return settings(TpmsKind::gyroid, network, period, thickness, region);
    };
    REQUIRE_THROWS_AS(make_tpms(with(0, 1)), InputError);
    REQUIRE_THROWS_AS(make_tpms(with(-2, 1)), InputError);
    REQUIRE_THROWS_AS(make_tpms(with(infinity, 1)), InputError);
    REQUIRE_THROWS_AS(make_tpms(with(std::nan(""), 1)), InputError);
    REQUIRE_THROWS_AS(make_tpms(with(2, 0)), InputError);
    REQUIRE_THROWS_AS(make_tpms(with(2, 0.6)), InputError);
    REQUIRE_NOTHROW(make_tpms(with(2, 0.5)));
    REQUIRE_NOTHROW(make_tpms(with(2, 0.6, true)));
    REQUIRE_THROWS_AS(make_tpms(with(2, 1.1, true)), InputError);
    REQUIRE_THROWS_AS(make_tpms(with(0.0009, 0.0001)), InputError);
    TpmsSettings s = with(2, 0.3);
    s.period = std::make_shared<Linear>(1, dvec3(-0.2, 0, 0));
    REQUIRE_THROWS_WITH(make_tpms(s), Catch::Contains("goes down to -1 mm; it must be positive"));
    s = with(2, 0.3);
    s.thickness = std::make_shared<Undefined>();
    REQUIRE_THROWS_AS(make_tpms(s), InputError);
    s = with(2, 0.3);
    s.thickness = nullptr;
    REQUIRE_THROWS_AS(make_tpms(s), InputError);
    s = with(2, 0.3);
    s.region = {};
    REQUIRE_THROWS_AS(make_tpms(s), InputError);
    s.region = {dvec3(0), dvec3(infinity)};
    REQUIRE_THROWS_AS(make_tpms(s), InputError);
    // Thick where the period is long: what counts is their quotient.
    s = with(2, 0.3);
    s.period = std::make_shared<Linear>(1, dvec3(1, 0, 0));
    s.thickness = std::make_shared<Linear>(0.2, dvec3(0.2, 0, 0));
    REQUIRE_NOTHROW(make_tpms(s));
}

}  // namespace tpms_test
