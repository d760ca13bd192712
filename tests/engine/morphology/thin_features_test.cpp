// What is too thin: against brute force, and what slack excuses.
#include "engine/morphology/thin_features.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/engine/morphology/through_layers.h"

namespace thin_features_test {

using namespace lamella;
using namespace lamella::test;

namespace {

constexpr int lines = 24, layers = 18, columns = 40;
using Stack = std::vector<RunRows>;

Stack random_stack(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> gap(run_unit / 2, 9 * run_unit), run(run_unit, 12 * run_unit);
    Stack stack(layers);
    for (RunRows& layer : stack) {
        for (int l = 0; l < lines; ++l) {
            for (int u = gap(random); u < columns * run_unit;) {
                const int end = u + run(random);
                layer.push(u, end);
                u = end + gap(random);
            }
            layer.end_line();
        }
    }
    return stack;
}

/// Whether a place of a line lies in a run.
bool solid(const Stack& stack, int z, int y, int u) {
    if (z < 0 || z >= static_cast<int>(stack.size()) || y < 0 || y >= lines) return false;
    for (const Run& run : stack[static_cast<std::size_t>(z)].line(static_cast<std::size_t>(y))) {
        if (run.begin <= u && u < run.end) return true;
    }
    return false;
}

/// Whether no void lies nearer to a place than r, along lines that `up` layers and all rows reach.
bool fits(const Stack& stack, int z, int y, int u, double r, double layer_pitch) {
    const int rows = static_cast<int>(r / run_unit), up = static_cast<int>(r / layer_pitch);
    for (int dz = -up; dz <= up; ++dz) {
        for (int dy = -rows; dy <= rows; ++dy) {
            const double left =
                r * r - dy * dy * double(run_unit) * run_unit - dz * dz * layer_pitch * layer_pitch;
            if (left < 0) continue;
            const int reach = static_cast<int>(std::sqrt(left));
            for (int v = u - reach; v <= u + reach; v += 8) {
                if (!solid(stack, z + dz, y + dy, v)) return false;
            }
        }
    }
    return true;
}

}  // namespace

TEST_CASE("what is thin lies far from every place where the ball fits", "[morphology]") {
    const double layer_pitch = 1.3 * run_unit;
    const Thinness thinness{1.6 * run_unit, 0.9 * run_unit};
    for (const unsigned seed : {1U, 2U}) {
        const Stack stack = random_stack(seed);
        const Stack thin = through(ThinFeatureStream({run_unit, layer_pitch, lines}, thinness), stack);
        REQUIRE(thin.size() == stack.size());
        // Places where the ball fits for sure (by a unit of rounding), and those where it just might.
        int near_checked = 0, far_checked = 0;
        const double reach = thinness.radius + thinness.slack;
        for (int z = 0; z < layers; z += 3) {
            for (int y = 0; y < lines; y += 5) {
                for (int u = 0; u < columns * run_unit; u += 170) {
                    if (!solid(stack, z, y, u)) {
                        CHECK(!solid(thin, z, y, u));
                        continue;
                    }
                    bool near = false, maybe_near = false;
                    for (int dz = -1; dz <= 1; ++dz) {
                        for (int dy = -2; dy <= 2; ++dy) {
                            const double left = reach * reach - dy * dy * double(run_unit) * run_unit -
                                                dz * dz * layer_pitch * layer_pitch;
                            if (left < 0) continue;
                            const int along = static_cast<int>(std::sqrt(left));
                            for (int v = u - along + 2; v <= u + along - 2 && !near; v += 16) {
                                near = fits(stack, z + dz, y + dy, v, thinness.radius + 18, layer_pitch);
                            }
                            for (int v = u - along - 2; v <= u + along + 2 && !maybe_near; v += 8) {
                                maybe_near =
                                    fits(stack, z + dz, y + dy, v, thinness.radius - 18, layer_pitch);
                            }
                        }
                    }
                    if (near) {
                        ++near_checked;
                        CHECK(!solid(thin, z, y, u));
                    } else if (!maybe_near) {
                        ++far_checked;
                        CHECK(solid(thin, z, y, u));
                    }
                }
            }
        }
        CHECK(near_checked > 20);
        CHECK(far_checked > 100);
    }
}

TEST_CASE("layers one by one are what a ball without height makes of them", "[morphology]") {
    const Stack stack = random_stack(3);
    const Thinness thinness{2.2 * run_unit, 1.1 * run_unit};
    const LayerLattice flat{run_unit, 100.0 * run_unit, lines};
    const Stack thin = through(ThinFeatureStream(flat, thinness), stack),
                narrow = through(ThinFeatureStream(flat, thinness, FeatureKind::gap), stack);
    RunRows rows;
    std::int64_t found = 0;
    for (std::size_t z = 0; z < stack.size(); ++z) {
        thin_rows(stack[z], FeatureKind::wall, thinness, run_unit, rows);
        CHECK(rows == thin[z]);
        found += rows.total_length();
        thin_rows(stack[z], FeatureKind::gap, thinness, run_unit, rows);
        CHECK(rows == narrow[z]);
        found += rows.total_length();
    }
    CHECK(found > 0);
}

TEST_CASE("what is thin beside many rows is what a ball without height finds", "[morphology]") {
    // Discs and bars of all sizes; from eight rows on candidate_cells are found by cells of several.
    constexpr int rows_across = 150;
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const double radius : {6.3, 8.0, 9.7, 13.1, 21.5}) {
        struct Disc {
            double y, u, r, lean;
        };
        std::vector<Disc> discs(30);
        for (Disc& disc : discs)
            disc = {150 * unit(random), 150 * unit(random), 2 + 30 * unit(random), unit(random)};
        RunRows rows;
        for (int y = 0; y < rows_across; ++y) {
            RunRows line, one, both;
            line.end_line();
            for (const Disc& disc : discs) {
                const double away = std::abs(y - disc.y) / (disc.lean < 0.5 ? 1 : 3);
                if (away >= disc.r) continue;
                const double half = std::sqrt(disc.r * disc.r - away * away) / (disc.lean < 0.5 ? 1 : 3);
                one.clear();
                one.push(static_cast<int>((disc.u - half) * run_unit),
                         static_cast<int>((disc.u + half) * run_unit) + 1);
                one.end_line();
                unite(line, one, both);
                std::swap(line, both);
            }
            rows.append_lines(line);
        }
        for (const double slack : {0.0, 0.5, 1.5}) {
            for (const double pitch : {1.0, 0.8}) {
                CAPTURE(radius, slack, pitch);
                const Thinness thinness{radius * run_unit, slack * radius * run_unit};
                const LayerLattice flat{pitch * run_unit, 1000.0 * run_unit, rows_across};
                RunRows found;
                for (const FeatureKind kind : {FeatureKind::wall, FeatureKind::gap}) {
                    thin_rows(rows, kind, thinness, flat.row_pitch, found);
                    CHECK(found == through(ThinFeatureStream(flat, thinness, kind), Stack{rows}).front());
                    if (slack == 0) CHECK(found.total_length() > 0);
                }
            }
        }
    }
}

TEST_CASE("what is narrow in a solid is what is thin in its void", "[morphology]") {
    // A solid all about, with a void in the middle: far from the border both are the same.
    const Stack voids = random_stack(4);
    Stack solid_stack;
    for (const RunRows& layer : voids) {
        RunRows rows;
        for (std::size_t l = 0; l < layer.lines(); ++l) {
            std::int32_t at = -20 * run_unit;
            for (const Run& run : layer.line(l)) {
                rows.push(at, run.begin);
                at = run.end;
            }
            rows.push(at, 80 * run_unit);
            rows.end_line();
        }
        solid_stack.push_back(rows);
    }
    const Thinness thinness{1.5 * run_unit, 1.2 * run_unit};
    const LayerLattice lattice{run_unit, 1.2 * run_unit, lines};
    const Stack thin = through(ThinFeatureStream(lattice, thinness), voids),
                narrow = through(ThinFeatureStream(lattice, thinness, FeatureKind::gap), solid_stack);
    std::int64_t differ = 0, all = 0;
    for (std::size_t z = 5; z + 5 < voids.size(); ++z) {
        for (std::size_t l = 6; l + 6 < lines; ++l) {
            RunRows a, b, common;
            a.append_line(thin[z].line(l));
            b.append_line(narrow[z].line(l));
            intersect(a, b, common);
            differ += a.total_length() + b.total_length() - 2 * common.total_length();
            all += static_cast<std::int64_t>(a.runs().size() + b.runs().size());
        }
    }
    CHECK(all > 100);
    CHECK(differ <= 2 * all);  // each end may be off by a unit
}

TEST_CASE("slack excuses edges and keeps fins", "[morphology]") {
    // A wedge of 60 degrees, and a fin.
    const auto rows_of = [](double (*half)(double)) {
        RunRows rows;
        for (int l = 0; l < 200; ++l) {
            const double w = half(l) * run_unit;
            if (w > 0) rows.push(static_cast<int>(100 * run_unit - w), static_cast<int>(100 * run_unit + w));
            rows.end_line();
        }
        return rows;
    };
    const RunRows wedge = rows_of([](double y) { return (y - 10) * 0.57735; }),
                  fin = rows_of([](double y) { return y < 100 ? 3.0 : 60.0; });
    const double r = 6 * run_unit;
    RunRows thin;
    thin_rows(wedge, FeatureKind::wall, {r, 0}, run_unit, thin);
    CHECK(thin.total_length() > 0);
    // The tip of a wedge of 60 degrees is a radius away from the ball in it.
    thin_rows(wedge, FeatureKind::wall, {r, 1.2 * r}, run_unit, thin);
    std::size_t last = 0;
    for (std::size_t l = 0; l < 150; ++l) {
        if (!thin.line(l).empty()) last = l;
    }
    CHECK(last == 0);
    thin_rows(fin, FeatureKind::wall, {r, 1.2 * r}, run_unit, thin);
    // All of the fin but what the slack excuses.
    CHECK(static_cast<double>(thin.total_length()) / run_unit == Approx(6 * (100 - 1.2 * 6)).epsilon(0.06));
}

}  // namespace thin_features_test
