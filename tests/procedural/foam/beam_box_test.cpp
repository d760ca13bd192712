// The beam against box test agrees with dense sampling of the box.
#include "procedural/foam/beam_box.h"

#include <catch2/catch.hpp>

#include "procedural/voronoi/counter_hash.h"

namespace beam_box_test {

using namespace lamella;

TEST_CASE("a beam passes a box's corner at its radius", "[beam_box]") {
    const Box box{dvec3(0), dvec3(1)};
    // The axis runs diagonally past the edge x = y = 1 at a distance of sqrt(2)/2.
    const auto beam = [](double r) { return Beam{{2.5, 0.5, 0.3}, r, {0.5, 2.5, 0.4}, r}; };
    CHECK_FALSE(touches(beam(0.7071), box));
    CHECK(touches(beam(0.7072), box));
    CHECK_FALSE(touches(beam(5), Box{}));
    CHECK(touches(Beam{dvec3(0.5), 0.1, dvec3(0.5), 0.1}, box));
    CHECK(touches(Beam{dvec3(-5), 0.1, dvec3(5), 0.1}, box));
}

TEST_CASE("touching agrees with the distance sampled over the box", "[beam_box]") {
    int both = 0, neither = 0;
    for (int sample = 0; sample < 400; ++sample) {
        INFO("sample " << sample);
        const CounterHash hash(31, 0, sample, 0, 0);
        const auto at = [&](std::uint64_t d) {
            return 4.0 * dvec3(hash.uniform(d), hash.uniform(d + 1), hash.uniform(d + 2)) - 2.0;
        };
        const Beam beam{at(0), 0.6 * hash.uniform(9), at(3), 0.6 * hash.uniform(10)};
        const Box box{dvec3(-0.5, -0.4, -0.3), dvec3(0.5, 0.4, 0.3)};
        constexpr int n = 20;
        double least = infinity;
        for (int z = 0; z <= n; ++z)
            for (int y = 0; y <= n; ++y)
                for (int x = 0; x <= n; ++x)
                    least = std::min(least,
                                     signed_distance(beam, box.lo + box.size() * dvec3(x, y, z) / double(n)));
        // Half the diagonal of the sampling lattice.
        if (least > 0.036) CHECK_FALSE(touches(beam, box));
        if (least <= 0) CHECK(touches(beam, box));
        both += least <= 0;
        neither += least > 0.036;
    }
    CHECK(both > 50);
    CHECK(neither > 50);
}

}  // namespace beam_box_test
