// Tiled volumes against sampling by the book, and their ranges against their numbers.
#include "procedural/volume/tiled_volume.h"

#include <catch2/catch.hpp>

#include "tests/procedural/grading/grading_checks.h"

namespace tiled_volume_test {

using namespace lamella;

namespace {

constexpr std::array<std::size_t, 3> size{4, 3, 2};

Volume random_volume(const std::array<std::size_t, 3>& sides) {
    Volume volume;
    volume.size = sides;
    std::mt19937 random(7);
    std::vector<std::uint8_t> samples;
    for (std::size_t i = 0; i < sides[0] * sides[1] * sides[2]; ++i)
        samples.push_back(static_cast<std::uint8_t>(random() & 255U));
    volume.samples = samples;
    volume.full_scale = 255;
    return volume;
}

/// The voxel of a tiling by its place among all voxels of all tiles.
std::size_t voxel(TileStyle style, long place, long n) {
    if (style == TileStyle::wrap) return static_cast<std::size_t>(((place % n) + n) % n);
    if (style == TileStyle::mirror) {
        const long within = ((place % (2 * n)) + 2 * n) % (2 * n);
        return static_cast<std::size_t>(within < n ? within : 2 * n - 1 - within);
    }
    return static_cast<std::size_t>(std::clamp(place, 0L, n - 1));
}

/// Trilinear sampling of the plane that is filled with tiles.
double linear(const Volume& volume, const std::array<TileStyle, 3>& tiles, dvec3 p) {
    const auto& samples = std::get<std::vector<std::uint8_t>>(volume.samples);
    double sum = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        double weight = 1;
        std::array<std::size_t, 3> at{};
        for (std::size_t i = 0; i < 3; ++i) {
            const double g = p[static_cast<int>(i)] * static_cast<double>(volume.size[i]) - 0.5;
            const long lower = static_cast<long>(std::floor(g)), upper = (corner >> i & 1U) != 0 ? 1 : 0;
            const double t = g - std::floor(g);
            weight *= upper != 0 ? t : 1 - t;
            at[i] = voxel(tiles[i], lower + upper, static_cast<long>(volume.size[i]));
        }
        sum += weight * samples[(at[2] * volume.size[1] + at[1]) * volume.size[0] + at[0]];
    }
    return sum / 255;
}

double nearest(const Volume& volume, const std::array<TileStyle, 3>& tiles, dvec3 p) {
    const auto& samples = std::get<std::vector<std::uint8_t>>(volume.samples);
    std::array<std::size_t, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double g = p[static_cast<int>(i)] * static_cast<double>(volume.size[i]);
        at[i] = voxel(tiles[i], static_cast<long>(std::floor(g)), static_cast<long>(volume.size[i]));
    }
    return samples[(at[2] * volume.size[1] + at[1]) * volume.size[0] + at[0]] / 255.0;
}

const Box around{{-2.3, -2.3, -2.3}, {3.1, 3.1, 3.1}};

}  // namespace

TEST_CASE("tiled volumes are sampled as the plane that they tile, and their ranges hold", "[image3d]") {
    const TileStyle style = GENERATE(TileStyle::wrap, TileStyle::mirror, TileStyle::clamp, TileStyle::none);
    const TileStyle other = GENERATE(TileStyle::wrap, TileStyle::clamp);
    const ImageFilter filter = GENERATE(ImageFilter::linear, ImageFilter::nearest);
    const bool larger = GENERATE(false, true);
    const std::array<std::size_t, 3> sides = larger ? std::array<std::size_t, 3>{1, 40, 17} : size;
    const std::array<TileStyle, 3> tiles{style, other, style};
    CAPTURE(static_cast<int>(style), static_cast<int>(other), static_cast<int>(filter), sides[0]);
    const Volume volume = random_volume(sides);
    const GradingPtr grading = make_tiled_volume(volume, filter, tiles);
    std::mt19937 random(11);
    for (int i = 0; i < 500; ++i) {
        const dvec3 p = checks::random_point(random, around);
        const double truth =
            filter == ImageFilter::linear ? linear(volume, tiles, p) : nearest(volume, tiles, p);
        CAPTURE(p.x, p.y, p.z);
        REQUIRE(grading->at(p) == Approx(truth).margin(1e-12));
    }
    checks::check_ranges(*grading, around);
    const Interval all = grading->range({dvec3(-infinity), dvec3(infinity)});
    CHECK(all.lo >= 0);
    CHECK(all.hi <= 1);
}

TEST_CASE("of two nearest voxels the one with the lower column, row and sheet counts", "[image3d]") {
    // Rows of the picture run against y: row i lies at y = 2 - i.
    Volume volume;
    volume.size = size;
    std::vector<std::uint8_t> samples;
    for (std::size_t z = 0; z < 2; ++z) {
        for (std::size_t y = 0; y < 3; ++y) {
            for (std::size_t x = 0; x < 4; ++x)
                samples.push_back(static_cast<std::uint8_t>(100 * z + 10 * (2 - y) + x));
        }
    }
    volume.samples = samples;
    volume.full_scale = 1;
    const std::array<TileStyle, 3> wrap{TileStyle::wrap, TileStyle::wrap, TileStyle::wrap};
    const GradingPtr grading = make_tiled_volume(volume, ImageFilter::nearest, wrap);
    // Both places are the specification's: row 0, column 0 and not row 1; row 1, column 1 and not column 2.
    CHECK(grading->at({1.0 / 8, 2.0 / 3, 0}) == 0);
    CHECK(grading->at({0.5, 0.5, 0}) == 11);
    CHECK(grading->at({0.5, 0.5, 0.5}) == 11);
    CHECK(grading->at({0.5, 0.5, 0.51}) == 111);
}

}  // namespace tiled_volume_test
