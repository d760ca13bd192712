// Bricks against the same samples one after the other in memory: values, gradings, fields.
#include "procedural/volume/density_bricks.h"

#include <bit>
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "engine/formula/formula_field.h"
#include "engine/formula/formula_parser.h"
#include "procedural/volume/volume_grading.h"
#include "tests/procedural/grading/grading_checks.h"
#include "tests/procedural/volume/clumped_densities.h"

namespace density_bricks_test {

using namespace lamella;

namespace {

const Box box{{-3, 2, 10}, {7, 8, 40}};
const std::vector<VoxelIndex> sizes{{1, 1, 1},  {8, 8, 8},    {16, 8, 24}, {7, 5, 6},   {9, 17, 1},
                                    {1, 40, 1}, {70, 33, 50}, {65, 8, 9},  {3, 100, 2}, {64, 64, 32}};

/// The bricks and the volume of the same samples, as gradings.
struct Both {
    GradingPtr dense, bricks;

    Both(const VoxelIndex& size, const std::vector<double>& samples) {
        Volume volume;
        volume.size = size;
        volume.samples = std::vector<float>(samples.begin(), samples.end());
        dense = make_volume_grading(std::move(volume), box);
        bricks = make_volume_grading(std::make_shared<const DensityBricks>(size, box, samples));
    }
};

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void check_same(const Both& both, unsigned seed) {
    std::mt19937 random(seed);
    for (int i = 0; i < 3000; ++i) {
        const dvec3 p = checks::random_point(random, grown(box, 2));
        const double dense = both.dense->at(p), bricks = both.bricks->at(p);
        if (!same_bits(dense, bricks) && !(std::isnan(dense) && std::isnan(bricks)))
            FAIL(bricks << " in bricks, " << dense << " in the volume");
    }
    for (int i = 0; i < 1000; ++i) {
        const dvec3 lo = checks::random_point(random, grown(box, 1));
        const dvec3 side = (checks::random_point(random, box) - box.lo) * std::pow(0.25, i % 7);
        const Interval dense = both.dense->range({lo, lo + side}),
                       bricks = both.bricks->range({lo, lo + side});
        if (!same_bits(dense.lo, bricks.lo) || !same_bits(dense.hi, bricks.hi))
            FAIL("a range of " << bricks.lo << " to " << bricks.hi << " in bricks, of " << dense.lo << " to "
                               << dense.hi << " in the volume");
    }
    checks::check_ranges(*both.bricks, grown(box, 1), seed);
}

/// How many samples the bricks of a volume need, counted brick by brick.
std::size_t samples_needed(const VoxelIndex& n, const std::vector<double>& samples) {
    std::size_t needed = 0;
    for (std::size_t z = 0; z < n[2]; z += 8) {
        for (std::size_t y = 0; y < n[1]; y += 8) {
            for (std::size_t x = 0; x < n[0]; x += 8) {
                std::vector<float> inside;
                for (std::size_t k = z; k < std::min(z + 8, n[2]); ++k) {
                    for (std::size_t j = y; j < std::min(y + 8, n[1]); ++j) {
                        for (std::size_t i = x; i < std::min(x + 8, n[0]); ++i)
                            inside.push_back(static_cast<float>(samples[i + n[0] * (j + n[1] * k)]));
                    }
                }
                const bool is_one = std::ranges::count(inside, inside[0]) == std::ssize(inside);
                needed += is_one ? 1 : inside.size();
            }
        }
    }
    return needed;
}

}  // namespace

TEST_CASE("bricks give every sample back, and keep those alone that differ within a brick") {
    unsigned seed = 1;
    for (const VoxelIndex& size : sizes) {
        const std::vector<double> samples = clumped_densities(size, ++seed);
        const DensityBricks bricks(size, box, samples);
        CHECK(bricks.dense() == std::vector<float>(samples.begin(), samples.end()));
        CHECK(bricks.samples().size() == samples_needed(size, samples));
        std::mt19937 random(seed);
        for (int i = 0; i < 100; ++i) {
            const std::size_t x = random() % size[0], y = random() % size[1], z = random() % size[2];
            CHECK(bricks.at(x, y, z) == static_cast<float>(samples[x + size[0] * (y + size[1] * z)]));
        }
        const DensityBricks again(size, box, bricks.whole(),
                                  {bricks.samples().begin(), bricks.samples().end()});
        CHECK(again.dense() == bricks.dense());
    }
    const std::vector<double> one(std::size_t{64} * 64 * 64, 0.3);
    CHECK(DensityBricks({64, 64, 64}, box, one).samples().size() == 512);
}

TEST_CASE("numbers and ranges of bricks are those of the volume, to the last bit") {
    unsigned seed = 20;
    for (const VoxelIndex& size : sizes) {
        ++seed;
        check_same({size, clumped_densities(size, seed)}, seed);
    }
}

TEST_CASE("bricks with numbers that are not finite, and zeros with a sign, are as the volume") {
    const VoxelIndex size{20, 17, 19};
    std::vector<double> samples = clumped_densities(size, 40);
    std::fill_n(samples.begin(), 20 * 17 * 9, std::numeric_limits<double>::quiet_NaN());
    samples[20 * 17 * 12 + 7] = infinity;
    samples[20 * 17 * 17 + 150] = -infinity;
    check_same({size, samples}, 41);
    const std::vector<double> zeros{0.0, -0.0, -0.0, -0.0};
    const DensityBricks signs({4, 1, 1}, box, zeros);
    CHECK(signs.samples().size() == 4);
    CHECK_FALSE(std::signbit(signs.at(0, 0, 0)));
    CHECK(std::signbit(signs.at(1, 0, 0)));
}

TEST_CASE("a field of bricks has the values, ranges and layers of that of the volume") {
    const VoxelIndex size{70, 33, 50};
    const Both both(size, clumped_densities(size, 50));
    const std::vector<std::string> names{"x", "y", "z", "density"};
    const Formula formula = parse_formula("0.5 - density", names);
    const FieldPtr dense = make_formula_field(formula, {both.dense}, box),
                   bricks = make_formula_field(formula, {both.bricks}, box);
    std::mt19937 random(51);
    for (int i = 0; i < 1000; ++i) {
        const dvec3 p = checks::random_point(random, box), q = checks::random_point(random, box);
        CHECK(same_bits(dense->value(p), bricks->value(p)));
        const Box part{glm::min(p, q), glm::max(p, q)};
        CHECK(same_bits(dense->range(part).lo, bricks->range(part).lo));
        CHECK(same_bits(dense->range(part).hi, bricks->range(part).hi));
    }
    RowBand band;
    band.along_origin = box.lo.x;
    band.across_origin = box.lo.y;
    band.along_pitch = band.across_pitch = 0.02;
    band.count = 300;
    band.hi = 500;
    std::int64_t solid = 0;
    for (double z = 10.05; z < 40; z += 1.7) {
        const auto rows_of = [&](const Field& field) {
            SliceContext context;
            Scratch scratch;
            const auto rows = scratch.rows();
            context.slice(field, z).runs(band, scratch, *rows);
            solid += rows->total_length();
            return RunRows(*rows);
        };
        CHECK(rows_of(*dense) == rows_of(*bricks));
    }
    CHECK(solid > 0);
}

TEST_CASE("bricks of other numbers are the samples' numbers") {
    const VoxelIndex size{30, 21, 9};
    const std::vector<double> samples = clumped_densities(size, 60);
    const DensityBricks bricks(size, box, samples);
    std::vector<float> expected;
    for (const double sample : samples) expected.push_back(3 - static_cast<float>(sample) / 7);
    CHECK(bricks.mapped([](float sample) { return 3 - sample / 7; }).dense() == expected);
}

TEST_CASE("bricks without a sample a voxel, or without a box, are refused") {
    const std::vector<double> two{1, 2}, none;
    CHECK_THROWS_AS(DensityBricks({3, 1, 1}, box, two), InputError);
    CHECK_THROWS_AS(DensityBricks({0, 1, 1}, box, none), InputError);
    CHECK_THROWS_AS(DensityBricks({std::size_t{1} << 33U, 1, 1}, box, two), InputError);
    CHECK_THROWS_AS(DensityBricks({2, 1, 1}, Box{{0, 0, 0}, {1, 0, 1}}, two), InputError);
    CHECK_THROWS_AS(DensityBricks({2, 1, 1}, Box{{0, 0, 0}, {1, infinity, 1}}, two), InputError);
    const std::vector<std::uint8_t> whole{1};
    CHECK_THROWS_AS(DensityBricks({2, 1, 1}, box, whole, {1.0F}), InputError);
    CHECK_NOTHROW(DensityBricks({2, 1, 1}, box, whole, {1.0F, 2.0F}));
}

}  // namespace density_bricks_test
