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

/// The gradient of g by differences of the library's sines.
dvec3 defined_gradient(TpmsKind kind, dvec3 u) {
    dvec3 gradient(0);
    for (int i = 0; i < 3; ++i) {
        dvec3 e(0);
        e[i] = 1e-5;
        gradient[i] = (defined_g(kind, u + e) - defined_g(kind, u - e)) / 2e-5;
    }
    return gradient;
}

/// Points of the surface g = 0, spread over one period, in a grid of cells: the distance from them is that
/// from the surface to within the points' spacing.
class SurfaceCloud {
  public:
    SurfaceCloud(TpmsKind kind, int count) : cells_(side * side * side) {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> angle(0, turn);
        while (count > 0) {
            dvec3 u(angle(random), angle(random), angle(random));
            for (int i = 0; i < 40; ++i) {
                const dvec3 gradient = defined_gradient(kind, u);
                dvec3 step = gradient * (-defined_g(kind, u) / std::max(glm::dot(gradient, gradient), 0.01));
                if (glm::length(step) > 0.3) step *= 0.3 / glm::length(step);
                u += step;
                if (glm::length(step) < 1e-9) break;
            }
            if (std::abs(defined_g(kind, u)) > 1e-7) continue;
            points_.push_back(u - turn * glm::floor(u / turn));
            cells_[cell(glm::ivec3(points_.back() / width))].push_back(points_.back());
            --count;
        }
    }

    const std::vector<dvec3>& points() const { return points_; }

    double distance(dvec3 p) const {
        const glm::ivec3 middle(glm::floor(p / width));
        double least = infinity;
        for (int ring = 0; ring <= side / 2 && least > (ring - 1) * width; ++ring) {
            for (int z = -ring; z <= ring; ++z) {
                for (int y = -ring; y <= ring; ++y) {
                    const bool face = std::abs(z) == ring || std::abs(y) == ring;
                    for (int x = -ring; x <= ring; x += face || ring == 0 ? 1 : 2 * ring)
                        least = std::min(least, distance_in(middle + glm::ivec3(x, y, z), p));
                }
            }
        }
        return least;
    }

  private:
    static constexpr int side = 40;
    static constexpr double turn = 2 * pi;
    static constexpr double width = turn / side;

    static std::size_t cell(glm::ivec3 c) {
        const auto wrap = [](int i) { return ((i % side) + side) % side; };
        return static_cast<std::size_t>((wrap(c.z) * side + wrap(c.y)) * side + wrap(c.x));
    }
    double distance_in(glm::ivec3 c, dvec3 p) const {
        const dvec3 shift = turn * glm::floor(dvec3(c) / static_cast<double>(side));
        double least = infinity;
        for (const dvec3 q : cells_[cell(c)]) least = std::min(least, glm::length(q + shift - p));
        return least;
    }

    std::vector<dvec3> points_;
    std::vector<std::vector<dvec3>> cells_;
};

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

/// Whether a graded solid has at each point the sign of the solid with the period and thickness of that
/// point.
void check_constant_solids(const TpmsSettings& s, const Field& field) {
    std::mt19937 random(9);
    for (int i = 0; i < 15; ++i) {
        const dvec3 p = checks::random_point(random, s.region);
        const auto constant =
            make_tpms(settings(s.kind, s.network, s.period->at(p), s.thickness->at(p), s.region));
        CHECK((field.value(p) < 0) == (constant->value(p) < 0));
    }
}

}  // namespace

TEST_CASE("the constants of the surfaces are those of their definitions", "[tpms]") {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> angle(0, 2 * pi);
    for (const TpmsKind kind : kinds) {
        INFO("kind " << static_cast<int>(kind));
        const TpmsConstants constants = tpms_constants(kind);
        double steepest = 0, sharpest = 0, greatest = 0;
        const auto look = [&](dvec3 u) {
            const dvec3 gradient = defined_gradient(kind, u);
            greatest = std::max(greatest, std::abs(defined_g(kind, u)));
            steepest = std::max(steepest, glm::length(gradient));
            const TpmsSample sample = tpms_sample(kind, tpms_point(u));
            CHECK(sample.g == Approx(defined_g(kind, u)).margin(1e-12));
            CHECK(glm::length(sample.gradient - gradient) < 1e-8);
            const glm::dmat3 hessian = tpms_hessian(kind, tpms_point(u));
            for (int i = 0; i < 3; ++i) {
                dvec3 e(0);
                e[i] = 1e-4;
                const dvec3 difference =
                    (defined_gradient(kind, u + e) - defined_gradient(kind, u - e)) / 2e-4;
                CHECK(glm::length(hessian[i] - difference) < 1e-5);
            }
            // Power iteration finds the greatest second derivative.
            dvec3 way(0.6, 0.5, 0.4);
            for (int i = 0; i < 8; ++i) way = hessian * (hessian * way) + way * 1e-9;
            sharpest = std::max(sharpest, glm::length(hessian * way) / glm::length(way));
        };
        for (int i = 0; i < 20000; ++i) look({angle(random), angle(random), angle(random)});
        for (int i = 0; i < 8 * 8 * 8; ++i) look(dvec3(i % 8, i / 8 % 8, i / 64) * (pi / 4));
        CHECK(greatest == Approx(constants.greatest).epsilon(0.001));
        CHECK(steepest == Approx(constants.steepest).epsilon(1e-6));
        CHECK(greatest <= constants.greatest + 1e-12);
        CHECK(steepest <= constants.steepest + 1e-6);
        CHECK(sharpest == Approx(constants.sharpest).epsilon(1e-3));
        CHECK(sharpest <= constants.sharpest + 1e-6);
        CHECK(hangs_together(kind, constants.joined + 0.02 * constants.greatest));
        CHECK_FALSE(hangs_together(kind, constants.joined - 0.02 * constants.greatest));
    }
}

TEST_CASE("runs end where the solid's value is zero, along rows and columns", "[tpms]") {
    const double period = 2.3, z = 0.71;
    const Box region{{-3, -4, -1}, {6, 5, 3}};
    for (const TpmsKind kind : kinds) {
        for (const bool network : {false, true}) {
            for (const double share : {0.03, 0.11, 0.22}) {
                for (const Axis axis : {Axis::x, Axis::y}) {
                    INFO("kind " << static_cast<int>(kind) << (network ? ", network" : ", sheet")
                                 << ", share " << share << (axis == Axis::x ? ", rows" : ", columns"));
                    const auto field = make_tpms(settings(kind, network, period, share * period, region));
                    const RowBand band = band_over(region, axis, 0.05);
                    const RunRows rows = runs_of(*field, band, z);
                    const auto solid = [&](double u, int line) {
                        return field->value(position(band, u, line, z)) < 0;
                    };
                    std::size_t ends = 0;
                    for (int l = 0; l < band.lines(); l += 17) {
                        std::vector<bool> inside(static_cast<std::size_t>(band.hi) * run_unit);
                        for (const Run& run : rows.line(static_cast<std::size_t>(l))) {
                            for (int u = run.begin; u < run.end; ++u)
                                inside[static_cast<std::size_t>(u)] = true;
                            ends += 2;
                        }
                        for (int u = 0; u < band.hi * run_unit; u += 11) {
                            const bool in = inside[static_cast<std::size_t>(u)];
                            // A unit that holds an end may fall to either side.
                            if (solid(u, l) == solid(u + 1, l)) REQUIRE(in == solid(u + 0.5, l));
                        }
                    }
                    CHECK(ends > 20);
                }
            }
        }
    }
}

TEST_CASE("a wall holds the points within half its thickness of the surface, and no others", "[tpms]") {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> place(0, 2 * pi);
    for (const TpmsKind kind : kinds) {
        INFO("kind " << static_cast<int>(kind));
        const SurfaceCloud cloud(kind, 150'000);
        const double spacing = 0.1;  // radians, the largest hole between the cloud's points
        double farthest = 0;
        std::vector<dvec3> points;
        std::vector<double> distances;
        for (int i = 0; i < 6000; ++i) {
            points.emplace_back(place(random), place(random), place(random));
            distances.push_back(cloud.distance(points.back()));
            farthest = std::max(farthest, distances.back());
        }
        CHECK(farthest <= tpms_constants(kind).farthest + spacing);
        CHECK(farthest > tpms_constants(kind).farthest * 0.93);
        for (const double share : {0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4}) {
            INFO("thickness " << share << " of the period");
            const double half = pi * share;
            const auto field = make_tpms(settings(kind, false, 2 * pi, 2 * half, {dvec3(-50), dvec3(50)}));
            int wrong = 0, wrong_bounds = 0, wrong_ranges = 0, solid = 0, near = 0;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const double value = field->value(points[i]), off = distances[i] - half;
                solid += value < 0;
                near += distances[i] < half;
                // The cloud is at most as near as the surface, so only points outside need its spacing.
                if (value < 0 ? off > spacing : off < 0) ++wrong;
                if (std::abs(value) > std::abs(off) + spacing) ++wrong_bounds;
                const Interval range = field->range({points[i] - 0.05, points[i] + 0.05});
                if (!(range.lo <= value && value <= range.hi)) ++wrong_ranges;
            }
            CHECK(wrong == 0);
            // Three percent of the wall, in the mean over the period.
            CHECK(solid == Approx(near).epsilon(0.03).margin(30));
            if (share > 0.3) continue;  // hardly an opening is left, and values there are not needed
            CHECK(wrong_bounds == 0);
            CHECK(wrong_ranges == 0);
        }
        // Along its normals the wall ends at half its thickness, up to where normals of other points meet.
        const double reach = kind == TpmsKind::neovius ? 0.1 : kind == TpmsKind::schwarz_d ? 0.22 : 0.28;
        std::normal_distribution<double> normal;
        for (const double share : {0.02, reach / 2, reach}) {
            const double half = share * 1.5;  // mm, at a period of 3
            const auto field = make_tpms(settings(kind, false, 3, 2 * half, {dvec3(-5), dvec3(5)}));
            for (std::size_t i = 0; i < 3000; ++i) {
                const dvec3 u = cloud.points()[i], middle = u * (3 / (2 * pi));
                const dvec3 outward = glm::normalize(defined_gradient(kind, u));
                REQUIRE(field->value(middle + outward * (half * 1.0001)) > 0);
                REQUIRE(field->value(middle - outward * (half * 1.0001)) > 0);
                REQUIRE(field->value(middle + outward * (half * 0.9999)) < 0);
                const dvec3 way = glm::normalize(dvec3(normal(random), normal(random), normal(random)));
                REQUIRE(field->value(middle + way * (half * 0.9999)) < 0);
            }
            CHECK(field->metric() == Metric::bound);
        }
    }
}

TEST_CASE("a network's struts have the thickness asked for, and no more where they are thinnest", "[tpms]") {
    // A minimum of g, the saddle beside it and the direction of the axis between them.
    struct Strut {
        TpmsKind kind;
        dvec3 saddle, axis;
        double length;
    };
    const Strut struts[] = {{TpmsKind::gyroid, {0, 1.5, 1.75}, {1, -1, 0}, std::sqrt(2.0) / 4},
                            {TpmsKind::schwarz_p, {0, 1, 1}, {1, 0, 0}, 1},
                            {TpmsKind::schwarz_d, {0.5, 0.5, 1.5}, {1, 1, 1}, std::sqrt(3.0) / 4},
                            {TpmsKind::neovius, {1, 0, 0}, {0, 1, -1}, 1 / std::sqrt(2.0)}};
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (const Strut& strut : struts) {
        INFO("kind " << static_cast<int>(strut.kind));
        for (const double share : {0.02, 0.05, 0.1, 0.15, 0.2}) {
            INFO("thickness " << share << " of the period");
            const double half = pi * share;
            const auto field =
                make_tpms(settings(strut.kind, true, 2 * pi, 2 * half, {dvec3(-50), dvec3(50)}));
            double nearest = -infinity;  // greatest value on the balls' spheres
            for (int i = 0; i <= 24; ++i) {
                const dvec3 center =
                    pi * (strut.saddle + glm::normalize(strut.axis) * (strut.length * i / 24));
                for (int k = 0; k < 4000; ++k) {
                    const dvec3 way = glm::normalize(dvec3(normal(random), normal(random), normal(random)));
                    nearest = std::max(nearest, field->value(center + way * half));
                }
            }
            // Solid up to the sphere, which touches the border to within a thousandth of the period.
            CHECK(nearest < 1e-3 * half);
            CHECK(nearest > -0.03 * half);
        }
    }
}

TEST_CASE("a solid with one graded number has the runs of its definition", "[tpms]") {
    const Box region{{-4, -3, -2}, {4, 3, 2}};
    for (const std::string graded : {"thickness", "period", "thickness by height"}) {
        for (const bool network : {false, true}) {
            for (const TpmsKind kind : kinds) {
                INFO("kind " << static_cast<int>(kind) << (network ? ", network" : ", sheet") << ", "
                             << graded);
                TpmsSettings s = settings(kind, network, 2.5, 0.3, region);
                if (graded == "period") {
                    s.period = std::make_shared<Linear>(2.5, dvec3(0.1, 0.05, -0.1));
                } else {
                    const bool by_height = graded != "thickness";
                    const dvec3 slope = by_height ? dvec3(0, 0, 0.05) : dvec3(0.05, 0.02, 0);
                    s.thickness = std::make_shared<Linear>(0.3, slope);
                }
                const auto field = make_tpms(s);
                CHECK(field->metric() == Metric::sign);
                check_values(*field, region);
                check_constant_solids(s, *field);
                const double z = -0.43, pitch = 0.08;
                for (const Axis axis : {Axis::x, Axis::y}) {
                    const RowBand band = band_over(region, axis, pitch);
                    const RunRows rows = runs_of(*field, band, z);
                    const auto solid = [&](double u, int l) {
                        return field->value(position(band, u, l, z)) < 0;
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
    REQUIRE_THROWS_AS(make_tpms(with(2, 0.95)), InputError);
    REQUIRE_NOTHROW(make_tpms(with(2, 0.9)));
    REQUIRE_NOTHROW(make_tpms(with(2, 1.5, true)));
    REQUIRE_THROWS_AS(make_tpms(with(2, 1.6, true)), InputError);
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
