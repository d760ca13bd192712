// The union of grown runs on the lines of a block against every run grown by itself, on every SIMD target.
#include "engine/morphology/simd_run_union.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/base/simd_target.h"

namespace simd_run_union_test {

using namespace lamella;

namespace {

constexpr Run extent{-6000, 14000};

struct Scene {
    LayerLattice lattice;
    LineBlock block;
    double radius;  // of about half of the balls
    std::vector<SourceLine> lines;
    std::vector<std::vector<WeightedRun>> runs;  // of the lines
    std::vector<Run> covered;
};

Scene random_scene(std::mt19937& random) {
    const auto between = [&](int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random); };
    Scene scene{
        {256.0 * between(1, 3), 256 + 0.37 * between(0, 500), 100},
        {between(0, 40), between(0, 40), between(1, SimdRunUnion::edge), between(1, SimdRunUnion::edge)},
        between(0, 2) * 128 + static_cast<double>(between(0, 1500)),
        {},
        {},
        {}};
    const int lines = between(0, 60), longest = between(1, 2000);
    for (int i = 0; i < lines; ++i) {
        std::vector<WeightedRun>& runs = scene.runs.emplace_back();
        std::int32_t at = between(-5000, 8000);
        for (int k = between(1, 3); k > 0; --k) {
            const double radius = between(0, 1) == 0 ? scene.radius : between(0, 1500);
            const std::int32_t end = std::min(at + between(1, longest), 12000);
            if (at < end) runs.push_back({at, end, radius * radius});
            at = end + between(1, 600);
        }
        if (between(0, 9) == 0) runs.insert(runs.begin(), {-unbounded, -5000 - between(0, 900), 90000});
        if (between(0, 9) == 0) runs.push_back({12000 + between(1, 900), unbounded, 90000});
    }
    for (const std::vector<WeightedRun>& runs : scene.runs)
        scene.lines.push_back(
            {scene.block.layer + between(-8, 12), scene.block.line + between(-8, 12), runs});
    for (std::int32_t at = between(-6000, 3000); between(0, 2) > 0 && at < 13000; at += between(1, 4000)) {
        scene.covered.push_back({at, at + between(1, 900)});
        at = scene.covered.back().end + 1;
    }
    return scene;
}

/// Which units of the extent a line of the block has covered.
std::vector<bool> covered_units(const Scene& scene, int z, int l) {
    std::vector<bool> units(static_cast<std::size_t>(extent.end - extent.begin), false);
    const auto cover = [&](std::int32_t begin, std::int32_t end) {
        for (std::int32_t u = std::max(begin, extent.begin); u < std::min(end, extent.end); ++u)
            units[static_cast<std::size_t>(u - extent.begin)] = true;
    };
    for (const Run& run : scene.covered) cover(run.begin, run.end);
    for (const SourceLine& line : scene.lines) {
        const double across = (scene.block.line + l - line.line) * scene.lattice.row_pitch;
        const double up = (scene.block.layer + z - line.layer) * scene.lattice.layer_pitch;
        for (const WeightedRun& run : line.runs) {
            const double left = run.weight - across * across - up * up;
            if (left < 0) continue;
            const RoundedExtent reach(std::sqrt(left));
            cover(run.begin - reach.back, run.end + reach.ahead);
        }
    }
    return units;
}

std::vector<Run> runs_of(const std::vector<bool>& units) {
    std::vector<Run> runs;
    for (std::size_t u = 0; u < units.size(); ++u) {
        const std::int32_t at = extent.begin + static_cast<std::int32_t>(u);
        if (!units[u]) continue;
        if (u > 0 && units[u - 1]) {
            ++runs.back().end;
        } else {
            runs.push_back({at, at + 1});
        }
    }
    return runs;
}

}  // namespace

TEST_CASE("the runs of a block's lines are the union of all that grow onto them", "[morphology]") {
    std::mt19937 random(11);
    for (int round = 0; round < 60; ++round) {
        const Scene scene = random_scene(random);
        const BallExtentTable reaches(scene.lattice, scene.radius * scene.radius);
        for (const std::string& target : simd_targets()) {
            INFO("round " << round << ", " << target);
            force_simd_target(target);
            SimdRunUnion united(scene.lattice, reaches, extent, scene.block.layers);
            for (int again = 0; again < 2; ++again) {  // nothing is left from the last time
                united.begin(scene.block);
                united.add_covered(scene.covered);
                united.add(scene.lines);
                united.unite();
            }
            force_simd_target("");
            for (int z = 0; z < scene.block.layers; ++z) {
                for (int l = 0; l < scene.block.lines; ++l) {
                    const std::span<const Run> line = united.line(z, l);
                    REQUIRE(std::vector<Run>(line.begin(), line.end()) ==
                            runs_of(covered_units(scene, z, l)));
                }
            }
        }
    }
}

}  // namespace simd_run_union_test
