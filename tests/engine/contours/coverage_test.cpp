// Coverage against analytic areas.
#include "engine/contours/coverage.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/field/slice_context.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"

namespace coverage_test {

using namespace lamella;

namespace {

using Pixels = std::vector<std::uint8_t>;

Pixels expand(const RowBand& band, const std::vector<GreyRun>& runs) {
    Pixels pixels;
    for (const GreyRun& run : runs) {
        REQUIRE(run.length > 0);
        pixels.insert(pixels.end(), run.length, static_cast<unsigned char>(run.value));
    }
    REQUIRE(pixels.size() ==
            static_cast<std::size_t>(band.count) * static_cast<std::size_t>(band.hi - band.lo));
    return pixels;
}

Pixels cover(const Field& field, const RowBand& band, bool exact) {
    SliceContext context;
    Scratch scratch;
    const SliceField& slice = context.slice(field, 0);
    std::vector<GreyRun> runs;
    if (exact) {
        coverage_exact(slice, band, scratch, runs);
    } else {
        RunRows rows;
        slice.runs(band, scratch, rows);
        coverage(band, rows, runs);
    }
    return expand(band, runs);
}

/// Area of the unit pixel at (i, j) within dot(n, p) <= d, by clipping the square.
double half_plane_area(int i, int j, dvec2 n, double d) {
    std::vector<dvec2> polygon = {{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}, kept;
    for (std::size_t k = 0; k < 4; ++k) {
        const dvec2 p = polygon[k], q = polygon[(k + 1) % 4];
        const double a = glm::dot(n, p) - d, b = glm::dot(n, q) - d;
        if (a <= 0) kept.push_back(p);
        if ((a < 0) != (b < 0) && a != b) kept.push_back(p + (q - p) * (a / (a - b)));
    }
    double twice = 0;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        const dvec2 p = kept[k], q = kept[(k + 1) % kept.size()];
        twice += p.x * q.y - p.y * q.x;
    }
    return twice / 2;
}

/// Area of the pixel within a disc, by fine rows in closed form.
double disc_area(int i, int j, dvec2 c, double r) {
    constexpr int rows = 512;
    double sum = 0;
    for (int k = 0; k < rows; ++k) {
        const double v = j + (k + 0.5) / rows - c.y, h = r * r - v * v;
        if (h <= 0) continue;
        const double lo = std::max<double>(i, c.x - std::sqrt(h)),
                     hi = std::min<double>(i + 1, c.x + std::sqrt(h));
        sum += std::max(0.0, hi - lo) / rows;
    }
    return sum;
}

template <typename Area>
void check_against(const Pixels& pixels, int n, Area area, double most, double mean_most) {
    double sum = 0, worst = 0;
    int border = 0;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const double expected = area(i, j), got = pixels[static_cast<std::size_t>(j * n + i)] / 255.0;
            worst = std::max(worst, std::abs(got - expected));
            if (expected > 1e-9 && expected < 1 - 1e-9) {
                sum += std::abs(got - expected);
                ++border;
            }
        }
    }
    INFO("worst " << worst << ", mean " << (border > 0 ? sum / border : 0) << " over " << border);
    REQUIRE(worst <= most);
    if (border > 0) REQUIRE(sum / border <= mean_most);
}

}  // namespace

TEST_CASE("half-planes at all angles are covered by their analytic area") {
    constexpr int n = 32;
    for (int angle = 0; angle < 360; angle += 3) {
        const double t = angle * 3.14159265358979323846 / 180;
        const dvec2 normal(std::cos(t), std::sin(t));
        const double d = glm::dot(normal, dvec2(16.3, 15.8));
        const auto area = [&](int i, int j) { return half_plane_area(i, j, normal, d); };
        const FieldPtr field =
            make_intersection({make_half_space({normal, 0}, d), make_box({{-99, -99, -9}, {99, 99, 9}})});
        INFO("angle " << angle);
        for (const int sub : {4, 8}) {
            INFO("sub-rows " << sub);
            const RowBand band{Axis::x, 0, 1, 0, 1, 0, n, sub, 0, n};
            check_against(cover(*field, band, false), n, area, 0.5 / sub + 1.0 / 256, 0.5 / sub + 1.0 / 256);
        }
        const RowBand band{Axis::x, 0, 1, 0, 1, 0, n, 1, 0, n};
        check_against(cover(*field, band, true), n, area, 1.0 / 64, 1.0 / 64);
    }
}

TEST_CASE("the mean over the border pixels of turned half-planes is within 1/64 with four sub-rows") {
    constexpr int n = 64;
    double sum = 0;
    int border = 0;
    for (int angle = 0; angle < 360; ++angle) {
        const double t = (angle + 0.37) * 3.14159265358979323846 / 180;
        const dvec2 normal(std::cos(t), std::sin(t));
        const double d = glm::dot(normal, dvec2(31.3, 32.8));
        const FieldPtr field = make_half_space({normal, 0}, d);
        const RowBand band{Axis::x, 0, 1, 0, 1, 0, n, 4, 0, n};
        const Pixels pixels = cover(*field, band, false);
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const double expected = half_plane_area(i, j, normal, d);
                if (expected < 1e-9 || expected > 1 - 1e-9) continue;
                sum += std::abs(pixels[static_cast<std::size_t>(j * n + i)] / 255.0 - expected);
                ++border;
            }
        }
    }
    REQUIRE(sum / border <= 1.0 / 64);
}

TEST_CASE("discs are covered by their analytic area") {
    constexpr int n = 40;
    for (const double r : {3.7, 9.25, 16.4}) {
        const dvec2 c(19.6, 20.3);
        const FieldPtr field = make_cylinder({c, -1}, {c, 1}, r);
        const auto area = [&](int i, int j) { return disc_area(i, j, c, r); };
        INFO("radius " << r);
        check_against(cover(*field, {Axis::x, 0, 1, 0, 1, 0, n, 4, 0, n}, false), n, area,
                      0.5 / 4 + 1.0 / 256, 1.0 / 64);
        check_against(cover(*field, {Axis::x, 0, 1, 0, 1, 0, n, 16, 0, n}, false), n, area,
                      0.5 / 16 + 1.0 / 256, 1.0 / 64);
        if (r > 5)
            check_against(cover(*field, {Axis::x, 0, 1, 0, 1, 0, n, 1, 0, n}, true), n, area, 1.0 / 64,
                          1.0 / 64);
    }
}

TEST_CASE("a flat top is solid, not grey") {
    const FieldPtr box = make_box({{2, 2, -1}, {8, 8, 1}});
    for (const bool exact : {false, true}) {
        const RowBand band{Axis::x, 0, 1, 0, 1, 0, 10, exact ? 1 : 4, 0, 10};
        const Pixels pixels = cover(*box, band, exact);
        for (int j = 0; j < 10; ++j) {
            for (int i = 0; i < 10; ++i) {
                const bool in = i >= 2 && i < 8 && j >= 2 && j < 8;
                const int got = pixels[static_cast<std::size_t>(j * 10 + i)];
                // The exact mode keeps crossings 1/256 away from pixel corners, and may cut half of a quarter
                // pixel off a corner.
                const bool corner = (i == 2 || i == 7) && (j == 2 || j == 7);
                REQUIRE(std::abs(got - (in ? 255 : 0)) <= (exact ? (corner ? 33 : 2) : 0));
            }
        }
    }
}

TEST_CASE("a mirrored band is the mirrored picture") {
    const FieldPtr shape =
        make_union({make_box({{1, 1, -1}, {3.3, 6.2, 1}}), make_box({{1, 1, -1}, {7.4, 2.7, 1}})});
    constexpr int n = 10;
    for (const bool exact : {false, true}) {
        const int sub = exact ? 1 : 4;
        const Pixels plain = cover(*shape, {Axis::x, 0, 1, 0, 1, 0, n, sub, 0, n}, exact);
        const Pixels mirrored = cover(*shape, {Axis::x, n, -1, 0, 1, 0, n, sub, 0, n}, exact);
        const Pixels flipped = cover(*shape, {Axis::x, 0, 1, n, -1, 0, n, sub, 0, n}, exact);
        const Pixels turned = cover(*shape, {Axis::y, 0, 1, 0, 1, 0, n, sub, 0, n}, exact);
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const auto at = [&](const Pixels& p, int x, int y) {
                    return int{p[static_cast<std::size_t>(y * n + x)]};
                };
                const int most = exact ? 33 : 2;
                REQUIRE(std::abs(at(plain, i, j) - at(mirrored, n - 1 - i, j)) <= most);
                REQUIRE(std::abs(at(plain, i, j) - at(flipped, i, n - 1 - j)) <= most);
                REQUIRE(std::abs(at(plain, i, j) - at(turned, j, i)) <= (exact ? most : 64));
            }
        }
    }
}

TEST_CASE("black and white pixels follow their centres") {
    RunRows rows;
    rows.push(128, 128 + 256);  // exactly from centre 0 to centre 1: pixel 0 only
    rows.push(3 * 256 + 129, 4 * 256 + 129);
    rows.end_line();
    std::vector<GreyRun> runs;
    const RowBand band{Axis::x, 0, 1, 0, 1, 0, 1, 1, 0, 6};
    threshold(band, rows, runs);
    REQUIRE(expand(band, runs) == Pixels{255, 0, 0, 0, 255, 0});
}

TEST_CASE("coverage rows sum to the width for runs at both ends") {
    RunRows rows;
    rows.push(0, 6 * 256);
    rows.end_line();
    rows.push(0, 1);
    rows.push(6 * 256 - 1, 6 * 256);
    rows.end_line();
    std::vector<GreyRun> runs;
    const RowBand band{Axis::x, 0, 1, 0, 1, 0, 2, 1, 0, 6};
    coverage(band, rows, runs);
    REQUIRE(expand(band, runs) == Pixels{255, 255, 255, 255, 255, 255, 1, 0, 0, 0, 0, 1});
}

TEST_CASE("random runs are covered as pixel by pixel, in runs as long as they can be") {
    std::mt19937 random(5);
    for (int trial = 0; trial < 200; ++trial) {
        RowBand band;
        band.lo = static_cast<int>(random() % 5) - 2;
        band.hi = band.lo + 1 + static_cast<int>(random() % 300);
        band.count = 3;
        band.sub = 1 + static_cast<int>(random() % 6);
        const int white = random() % 2 == 0 ? white_of_8_bits : white_of_16_bits;
        const int width = band.hi - band.lo;
        const auto shortest = 1 + static_cast<std::int32_t>(random() % 500);
        RunRows rows;
        for (int line = 0; line < band.lines(); ++line) {
            auto u = band.lo * run_unit + static_cast<std::int32_t>(random() % 3) * shortest;
            while (u < band.hi * run_unit) {
                const auto end = u + 1 + static_cast<std::int32_t>(random() % 1000);
                rows.push(u, std::min(end, band.hi * run_unit));
                u = end + shortest;
            }
            rows.end_line();
        }
        std::vector<GreyRun> runs;
        coverage(band, rows, runs, white);

        std::size_t next = 0;
        for (int row = 0; row < band.count; ++row) {
            std::vector<std::int64_t> covered(static_cast<std::size_t>(width));
            for (int k = 0; k < band.sub; ++k) {
                for (const Run& run : rows.line(static_cast<std::size_t>(row * band.sub + k))) {
                    for (std::int32_t u = run.begin; u < run.end; ++u)
                        ++covered[static_cast<std::size_t>(u - band.lo * run_unit) / run_unit];
                }
            }
            const int full = run_unit * band.sub;
            std::uint32_t at = 0;
            int last = -1;
            while (at < covered.size()) {
                REQUIRE(next < runs.size());
                const GreyRun run = runs[next++];
                REQUIRE(run.length > 0);
                REQUIRE(run.value != last);
                last = run.value;
                for (std::uint32_t i = 0; i < run.length; ++i, ++at) {
                    REQUIRE(at < covered.size());
                    REQUIRE(run.value == (covered[at] * white + full / 2) / full);
                }
            }
        }
        REQUIRE(next == runs.size());
    }
}

}  // namespace coverage_test
