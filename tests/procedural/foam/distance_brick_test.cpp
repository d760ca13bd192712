// A brick's short lists give the distance to the nearest of all beams.
#include "procedural/foam/distance_brick.h"

#include <catch2/catch.hpp>

#include "procedural/foam/beam_box.h"
#include "procedural/voronoi/counter_hash.h"

namespace distance_brick_test {

using namespace lamella;

TEST_CASE("a brick's distance is the minimum over all beams", "[distance_brick]") {
    for (const int count : {1, 3, 40, 400}) {
        CAPTURE(count);
        std::vector<Beam> beams;
        for (int i = 0; i < count; ++i) {
            const CounterHash hash(13, 0, i, count, 0);
            const auto at = [&](std::uint64_t d) {
                return 10.0 * dvec3(hash.uniform(d), hash.uniform(d + 1), hash.uniform(d + 2));
            };
            const dvec3 a = at(0);
            beams.push_back({a, 0.2 * hash.uniform(7), a + 0.2 * (at(3) - 5.0), 0.2 * hash.uniform(8)});
        }
        const Box box{dvec3(4), dvec3(6)};
        const DistanceBrick brick(box, [&](const Box& near) {
            std::vector<Beam> touching;
            for (const Beam& beam : beams) {
                if (touches(beam, near)) touching.push_back(beam);
            }
            return touching;
        });
        for (int i = 0; i < 2000; ++i) {
            const CounterHash hash(14, 0, i, 0, 0);
            const dvec3 p = 4.0 + 2.0 * dvec3(hash.uniform(0), hash.uniform(1), hash.uniform(2));
            double expected = infinity;
            for (const Beam& beam : beams) expected = std::min(expected, signed_distance(beam, p));
            REQUIRE(brick.distance(p) == expected);
        }
    }
}

}  // namespace distance_brick_test
