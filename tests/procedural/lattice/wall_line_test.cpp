// Tabulated distances along lines against those of single points.
#include "procedural/lattice/wall_line.h"

#include <catch2/catch.hpp>
#include <random>

namespace wall_line_test {

using namespace lamella;

TEST_CASE("a line of a wall has the distances of its points, for every thickness", "[tpms]") {
    std::mt19937 random(12);
    std::uniform_real_distribution<double> turns(-3, 3), angle(0, 2 * pi);
    for (const TpmsKind kind :
         {TpmsKind::gyroid, TpmsKind::schwarz_p, TpmsKind::schwarz_d, TpmsKind::neovius}) {
        INFO("kind " << static_cast<int>(kind));
        const TpmsWall wall(kind);
        const double greatest = wall.radius_of_uniqueness();
        double error = 0;
        int solid = 0, wrong = 0;
        for (int i = 0; i < 60; ++i) {
            const Axis axis = i % 2 == 0 ? Axis::x : Axis::y;
            const double turn = turns(random);
            const SineCosine across = sine_cosine(2 * pi * turn), z = sine_cosine(angle(random));
            const WallPlane plane(wall, z);
            const WallLine line(plane, axis, turn);
            for (int k = 0; k < 400; ++k) {
                const double t = turns(random);
                const TpmsPoint point = tpms_point_on(axis, sine_cosine(2 * pi * t), across, z);
                for (const double half : {greatest, greatest / 2, greatest / 8}) {
                    const double exact = wall.value(point, half), tabulated = line.bound(t, half);
                    if (std::abs(exact) > 1e-4 && (exact < 0) != (tabulated < 0)) ++wrong;
                    if (!(exact < 0)) continue;
                    ++solid;
                    // Where no piece is tabulated the bound may be nearer to zero.
                    error = std::max(error, exact - tabulated);
                }
            }
        }
        CHECK(solid > 1000);
        CHECK(wrong == 0);
        CHECK(error < 1e-4);
    }
}

TEST_CASE("where a line of a wall is called monotone, its bounds rise or fall", "[tpms]") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> turns(-3, 3), angle(0, 2 * pi), width(0.01, 0.2);
    for (const TpmsKind kind :
         {TpmsKind::gyroid, TpmsKind::schwarz_p, TpmsKind::schwarz_d, TpmsKind::neovius}) {
        INFO("kind " << static_cast<int>(kind));
        const TpmsWall wall(kind);
        int monotone = 0, wrong = 0;
        for (int i = 0; i < 40; ++i) {
            const WallPlane plane(wall, sine_cosine(angle(random)));
            const WallLine line(plane, i % 2 == 0 ? Axis::x : Axis::y, turns(random));
            for (int k = 0; k < 200; ++k) {
                const double from = turns(random), to = from + width(random);
                for (const double change : {0.0, 0.1, 0.4}) {
                    if (!line.is_monotone(from, to, change)) continue;
                    ++monotone;
                    // The half thickness grows, or shrinks, as fast as it may.
                    for (const double growth : {change, -change}) {
                        constexpr int samples = 60;
                        const auto at = [&](int s) {
                            const double t = from + (to - from) * s / samples;
                            return line.bound(t, 0) - growth * (t - from) * (2 * pi);
                        };
                        const bool rises = at(samples) > at(0);
                        for (int s = 0; s < samples; ++s) wrong += (at(s + 1) > at(s)) != rises ? 1 : 0;
                    }
                }
            }
            CHECK(!line.is_monotone(0.1, 1.2, 0));
        }
        CHECK(monotone > 400);
        CHECK(wrong == 0);
    }
}

}  // namespace wall_line_test
