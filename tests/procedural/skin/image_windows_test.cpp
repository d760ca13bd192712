// Pictures as struts: pixels, least widths, islands, and their projection on a body.
#include "procedural/skin/image_windows.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "engine/base/error.h"
#include "engine/solids/primitives.h"
#include "procedural/skin/raster.h"

namespace image_windows_test {

using namespace lamella;

namespace {

/// A picture from rows of text, the upper one first: # is dark.
Volume picture(const std::vector<std::string>& rows) {
    Volume volume;
    volume.size = {rows.front().size(), rows.size(), 1};
    std::vector<std::uint8_t> samples;
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
        for (const char c : *row) samples.push_back(c == '#' ? 0 : 255);
    }
    volume.samples = std::move(samples);
    volume.full_scale = 255;
    return volume;
}

const std::vector<std::string> grid{"########",  //
                                    "#......#",  //
                                    "#......#",  //
                                    "#......#",  //
                                    "########",  //
                                    "###....#",  //
                                    "###....#",  //
                                    "###....#"};

TiledMask random_mask(int width, int height, double share, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    TiledMask mask(width, height);
    for (auto& pixel : mask.marked) pixel = unit(random) < share ? 1 : 0;
    return mask;
}

}  // namespace

TEST_CASE("distances on a tiled raster are those to the nearest of all copies") {
    for (const double share : {0.02, 0.3}) {
        const TiledMask mask = random_mask(23, 17, share, 4);
        REQUIRE(mask.count() > 0);
        const auto squares = squared_distances(mask);
        for (int y = 0; y < 17; ++y) {
            for (int x = 0; x < 23; ++x) {
                std::int64_t least = no_pixel;
                for (int v = -17; v < 34; ++v) {
                    for (int u = -23; u < 46; ++u) {
                        const std::int64_t dx = u - x, dy = v - y;
                        if (mask.marked[mask.index((u + 23) % 23, (v + 17) % 17)])
                            least = std::min(least, dx * dx + dy * dy);
                    }
                }
                REQUIRE(squares[mask.index(x, y)] == least);
            }
        }
    }
    const auto none = squared_distances(TiledMask(5, 4));
    CHECK(std::all_of(none.begin(), none.end(), [](std::int64_t d) { return d == no_pixel; }));
}

TEST_CASE("components go on when they lead round the tile") {
    TiledMask mask(6, 6);
    for (int x = 0; x < 6; ++x) mask.marked[mask.index(x, 1)] = 1;
    mask.marked[mask.index(2, 4)] = mask.marked[mask.index(3, 3)] = 1;
    const auto parts = components_of(mask);
    REQUIRE(parts.size() == 2);
    CHECK(parts[0].goes_on);
    CHECK(parts[0].pixels.size() == 6);
    CHECK_FALSE(parts[1].goes_on);
    CHECK(parts[1].pixels.size() == 2);
}

TEST_CASE("a picture's pixels stand on a flat face where they are, one for one") {
    // Pixels of 1 mm; all struts are wide enough for the one asked for.
    const StrutImage image(picture(grid), {8, 0.9, 0.5, false});
    CHECK(image.islands() == 0);
    const FieldPtr box = make_box({{-16, -16, -5}, {16, 16, 5}});
    const ImageWindows windows(image, *box, 0.9, 1);
    int open = 0;
    for (int j = 1; j < 31; ++j) {
        for (int i = 1; i < 31; ++i) {
            const char pixel = grid[static_cast<std::size_t>(7 - j % 8)][static_cast<std::size_t>(i % 8)];
            INFO("pixel " << i << " " << j);
            // Seen from above x goes to the right, from below to the left.
            CHECK((windows.value({-16 + i + 0.5, -16 + j + 0.5, 4.6}) > 0) == (pixel == '.'));
            CHECK((windows.value({16 - i - 0.5, -16 + j + 0.5, -4.6}) > 0) == (pixel == '.'));
            open += pixel == '.';
        }
    }
    CHECK(open > 300);
}

TEST_CASE("a picture reads the same way round from every side") {
    const StrutImage image(picture(grid), {8, 0.9, 0.5, false});
    const Box bounds{{-16, -12, -8}, {16, 12, 8}};
    const ImageWindows windows(image, *make_box(bounds), 0.9, 1);
    const auto row = [&](int i, int j) {
        return grid[static_cast<std::size_t>(7 - j % 8)][static_cast<std::size_t>(i % 8)] == '.';
    };
    for (int j = 1; j < 15; ++j) {
        for (int i = 1; i < 23; ++i) {
            const double u = i + 0.5, z = bounds.lo.z + j + 0.5;
            CHECK((windows.value({bounds.lo.x + u, -11.7, z}) > 0) == row(i, j));
            CHECK((windows.value({bounds.hi.x - u, 11.7, z}) > 0) == row(i, j));
            CHECK((windows.value({15.7, bounds.lo.y + u, z}) > 0) == row(i, j));
            CHECK((windows.value({-15.7, bounds.hi.y - u, z}) > 0) == row(i, j));
        }
    }
}

TEST_CASE("a strut that the picture draws too thin is widened to the least width") {
    // Lines of 0.1 mm where 0.6 mm are wanted, crossing in a square of 20 mm.
    std::vector<std::string> rows(200, std::string(200, '.'));
    for (std::size_t k = 0; k < 200; ++k) rows[50][k] = rows[k][120] = '#';
    const StrutImage image(picture(rows), {20, 0.6, 0.5, false});
    double open = 20 * 20 - 2 * 20 * 0.6 + 0.6 * 0.6;
    CHECK(image.open_share() * 400 == Approx(open).epsilon(0.01));
    // Across the lines, away from where they cross.
    for (const double at : {2.0, 5.0, 17.3}) {
        double width = 0;
        for (int k = -2000; k < 2000; ++k) width += image.value(at, 14.95 + k * 5e-4) < 0 ? 5e-4 : 0;
        CHECK(width >= 0.6);
        CHECK(width < 0.6 + 3 * 0.034);
    }
}

TEST_CASE("every solid point lies in a disc of the least width that is solid") {
    const TiledMask noise = random_mask(40, 40, 0.5, 9);
    std::vector<std::string> rows(120, std::string(120, '.'));
    for (std::size_t y = 0; y < 120; ++y) {
        for (std::size_t x = 0; x < 120; ++x) {
            if (noise.marked[noise.index(static_cast<int>(x / 3), static_cast<int>(y / 3))]) rows[y][x] = '#';
        }
    }
    const double strut = 1.1, size = 24, cell = size / 120;
    const StrutImage image(picture(rows), {size, strut, 0.5, false});
    std::mt19937 random(6);
    std::uniform_real_distribution<double> at(0, size);
    const auto disc_is_solid = [&](dvec2 c) {
        // A raster's disc is up to a pixel of the finer raster less than a disc.
        const double radius = strut / 2 - cell / 2;
        for (int k = 0; k < 32; ++k) {
            const double a = k * 0.19634954;
            if (image.value(c.x + radius * std::cos(a), c.y + radius * std::sin(a)) > 0) return false;
        }
        return image.value(c.x, c.y) < 0;
    };
    int solid = 0;
    for (int round = 0; round < 400; ++round) {
        const dvec2 p(at(random), at(random));
        if (image.value(p.x, p.y) > -0.02) continue;
        ++solid;
        bool covered = false;
        for (int i = -12; i <= 12 && !covered; ++i) {
            for (int j = -12; j <= 12 && !covered; ++j) {
                const dvec2 way = dvec2(i, j) * (strut / 24);
                covered = glm::dot(way, way) <= strut * strut / 4 && disc_is_solid(p + way);
            }
        }
        INFO(p.x << " " << p.y);
        REQUIRE(covered);
    }
    CHECK(solid > 100);
}

TEST_CASE("islands are left out and counted; a picture of islands alone is refused") {
    std::vector<std::string> rows(32, "###" + std::string(29, '.'));
    for (std::size_t y = 0; y < 3; ++y) rows[y] = std::string(32, '#');
    for (std::size_t y = 14; y < 20; ++y) rows[y].replace(14, 6, 6, '#');
    const StrutImage image(picture(rows), {32, 0.9, 0.5, false});
    CHECK(image.islands() == 1);
    CHECK(image.value(17, 15) > 0);
    std::vector<std::string> dots(32, std::string(32, '.'));
    for (std::size_t y = 8; y < 14; ++y) dots[y].replace(10, 6, 6, '#');
    CHECK_THROWS_WITH(StrutImage(picture(dots), {32, 1, 0.5, false}), Catch::Contains("islands"));
    CHECK_NOTHROW(StrutImage(picture(dots), {32, 1, 0.5, true}));
    CHECK_THROWS_WITH(StrutImage(picture({"####", "####"}), {4, 1, 0.5, false}), Catch::Contains("window"));
    CHECK_THROWS_WITH(StrutImage(picture(grid), {8, 0, 0.5, false}), Catch::Contains("positive"));
    Volume stack = picture(grid);
    stack.size = {8, 4, 2};
    CHECK_THROWS_WITH(StrutImage(stack, {8, 1, 0.5, false}), Catch::Contains("needs one"));
}

TEST_CASE("a strut runs along the seams, at least as wide as stated on both sides together") {
    const StrutImage image(picture(grid), {8, 0.9, 0.5, false});
    const double strut = 0.9, half = 8;
    const ImageWindows windows(image, *make_box({dvec3(-half), dvec3(half)}), strut, 1);
    for (int k = -60; k <= 60; ++k) {
        const double y = k * 0.1;
        for (const double away : {0.0, 0.2, 0.44}) {
            CHECK(windows.value({half - away, y, half}) < 0);
            CHECK(windows.value({half, y, half - away}) < 0);
        }
    }
    // On a ball the axes change where two components of the normal are equal.
    const ImageWindows ball(image, *make_sphere(dvec3(0), 9), strut, 1);
    for (int k = -20; k <= 20; ++k) {
        const dvec3 way(1, k * 0.04, 1);
        const dvec3 p = way * (8.7 / std::sqrt(glm::dot(way, way)));
        const dvec3 across(std::sqrt(0.5), 0, -std::sqrt(0.5));
        for (const double off : {-0.35, 0.0, 0.35}) CHECK(ball.value(p + across * off) < 0);
    }
}

TEST_CASE("a hint, right or wrong, changes no value") {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> place(-6, 6);
    const FieldPtr ball = make_sphere(dvec3(0), 5);
    const StrutImage image(picture(grid), {4, 0.5, 0.5, false});
    const ImageWindows windows(image, *ball, 0.5, 1);
    std::uint32_t kept = 0;
    int open = 0;
    for (int i = 0; i < 20000; ++i) {
        const dvec3 p(place(random), place(random), place(random));
        std::uint32_t any = static_cast<std::uint32_t>(random());
        const double expected = windows.value(p);
        REQUIRE(windows.value_near(p, any) == expected);
        REQUIRE(windows.value_near(p, kept) == expected);
        // From where the hint was left, too.
        REQUIRE(windows.value_near(p + dvec3(0.01), kept) == windows.value(p + dvec3(0.01)));
        open += expected > 0 ? 1 : 0;
    }
    CHECK(open > 500);
}

TEST_CASE("no strut of a picture begins or ends nearer than the value says") {
    const StrutImage image(picture(grid), {8, 0.9, 0.5, false});
    const ImageWindows windows(image, *make_sphere(dvec3(0), 9), 0.9, 1);
    std::mt19937 random(12);
    std::normal_distribution<double> normal(0, 1);
    std::uniform_real_distribution<double> depth(0, 0.8), step(-0.6, 0.6);
    int far = 0, open = 0;
    for (int round = 0; round < 60000; ++round) {
        dvec3 p(normal(random), normal(random), normal(random));
        p *= (9 - depth(random)) / std::sqrt(glm::dot(p, p));
        const dvec3 q = p + dvec3(step(random), step(random), step(random));
        const double out = std::sqrt(glm::dot(q, q));
        if (out > 9.2 || out < 7.9) continue;
        const double v = windows.value(p), w = windows.value(q);
        if (std::sqrt(glm::dot(p - q, p - q)) * (1 + 1e-9) >= std::abs(v) || w == 0) continue;
        ++far;
        open += v > 0;
        REQUIRE((v < 0) == (w < 0));
    }
    CHECK(far > 1000);
    CHECK(open > 500);
}

}  // namespace image_windows_test
