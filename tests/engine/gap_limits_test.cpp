// What is left of a gap against every source grown by itself, on every SIMD target.
#include "engine/gap_limits.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <random>

#include "engine/simd_target.h"

using namespace lamella;

namespace {

constexpr Run gap{1000, 9000};

struct Scene {
    LayerLattice lattice;
    LineBlock block;
    double radius;  // of about half of the balls
    std::vector<GapSource> left, right, within;
};

Scene random_scene(std::mt19937& random) {
    const auto between = [&](int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random); };
    Scene scene{{256.0 * between(1, 3), 256 + 0.37 * between(0, 500), 100},
                {between(0, 40), between(0, 40), between(1, GapLimits::edge), between(1, GapLimits::edge)},
                static_cast<double>(between(1, 5000)),
                {},
                {},
                {}};
    const auto source = [&](std::int32_t begin, std::int32_t end) {
        const double radius = between(0, 1) == 0 ? scene.radius : between(1, 5000);
        return GapSource{begin,
                         end,
                         radius * radius,
                         scene.block.layer + between(-8, 12),
                         scene.block.line + between(-8, 12),
                         static_cast<std::int32_t>(radius) + 1};
    };
    for (int i = between(0, 40); i > 0; --i) {
        const std::int32_t begin = between(-5000, gap.begin);
        scene.left.push_back(source(begin, begin + between(1, 4000)));
    }
    for (int i = between(0, 40); i > 0; --i) {
        const std::int32_t end = between(gap.end, 15000);
        scene.right.push_back(source(end - between(1, 4000), end));
    }
    for (int i = between(0, 20); i > 0; --i) {
        const std::int32_t begin = between(gap.begin + 1, gap.end - 2);
        scene.within.push_back(source(begin, std::min(begin + between(1, 500), gap.end - 1)));
    }
    return scene;
}

/// The source on a line, grown and rounded by itself.
std::optional<Run> grown(const Scene& scene, const GapSource& source, int z, int l) {
    const double across = (scene.block.line + l - source.line) * scene.lattice.row_pitch;
    const double up = (scene.block.layer + z - source.layer) * scene.lattice.layer_pitch;
    const double left = source.weight - across * across - up * up;
    if (left < 0) return std::nullopt;
    const BallReach reach(std::sqrt(left));
    return Run{source.begin - reach.back, source.end + reach.ahead};
}

/// Which units of the gap are covered, by one run or another.
std::vector<bool> covered_units(const std::vector<Run>& runs) {
    std::vector<bool> units(static_cast<std::size_t>(gap.end - gap.begin), false);
    for (const Run& run : runs) {
        for (std::int32_t u = std::max(run.begin, gap.begin); u < std::min(run.end, gap.end); ++u)
            units[static_cast<std::size_t>(u - gap.begin)] = true;
    }
    return units;
}

}  // namespace

TEST_CASE("what grown runs leave of a gap is what each of them leaves", "[morphology]") {
    std::mt19937 random(11);
    for (int round = 0; round < 60; ++round) {
        const Scene scene = random_scene(random);
        const BallReaches reaches(scene.lattice, scene.radius * scene.radius);
        for (const std::string& target : simd_targets()) {
            INFO("round " << round << ", " << target);
            force_simd_target(target);
            GapLimits limits;
            std::array<std::vector<Run>, GapLimits::lines> islands;
            limits.begin(scene.block, gap);
            limits.grow_left(scene.lattice, reaches, scene.block, scene.left);
            limits.grow_right(scene.lattice, reaches, scene.block, scene.right);
            limits.grow_within(scene.lattice, reaches, scene.block, scene.within, islands);
            force_simd_target("");
            for (int z = 0; z < scene.block.layers; ++z) {
                for (int l = 0; l < scene.block.lines; ++l) {
                    std::vector<Run> expected;
                    for (const auto* sources : {&scene.left, &scene.right, &scene.within}) {
                        for (const GapSource& source : *sources) {
                            if (const auto run = grown(scene, source, z, l)) expected.push_back(*run);
                        }
                    }
                    std::vector<Run> found = islands[GapLimits::place(z, l)];
                    const Run left = limits.at(z, l);
                    found.push_back({gap.begin, left.begin});
                    found.push_back({std::max(left.begin, left.end), gap.end});
                    REQUIRE(covered_units(found) == covered_units(expected));
                }
            }
        }
    }
}
