// The round triangle against box test agrees with dense sampling of the box.
#include "procedural/foam/foam_piece.h"

#include <catch2/catch.hpp>

#include "procedural/foam/distance_brick.h"
#include "procedural/voronoi/counter_hash.h"

namespace foam_piece_test {

using namespace lamella;

namespace {

RoundTriangle random_triangle(int sample, double spread, double thickest) {
    const CounterHash hash(32, 0, sample, 0, 0);
    const auto at = [&](std::uint64_t d) {
        return spread * (2.0 * dvec3(hash.uniform(d), hash.uniform(d + 1), hash.uniform(d + 2)) - 1.0);
    };
    const auto radius = [&](std::uint64_t d) { return thickest * hash.uniform(d); };
    return {{at(0), at(3), at(6)}, {radius(9), radius(10), radius(11)}};
}

}  // namespace

TEST_CASE("a round triangle touches a box that its face pierces, and one that lies on its face",
          "[foam_piece]") {
    const RoundTriangle plate{{dvec3(-9, -9, 0), dvec3(9, -9, 0), dvec3(0, 9, 0)}, {0.25, 0.25, 0.25}};
    CHECK(touches(plate, {{-0.1, -0.1, -5}, {0.1, 0.1, 5}}));
    CHECK(touches(plate, {{-0.1, -0.1, 0.2499}, {0.1, 0.1, 5}}));
    CHECK_FALSE(touches(plate, {{-0.1, -0.1, 0.2501}, {0.1, 0.1, 5}}));
    CHECK_FALSE(touches(plate, {{-0.1, 9.2501, -5}, {0.1, 9.5, 5}}));
    CHECK_FALSE(touches(plate, Box{}));
    CHECK(touches(FoamPiece(plate), {dvec3(-0.01), dvec3(0.01)}));
}

TEST_CASE("touching a round triangle agrees with the distance sampled over the box", "[foam_piece]") {
    int both = 0, neither = 0;
    for (int sample = 0; sample < 600; ++sample) {
        INFO("sample " << sample);
        const RoundTriangle t = random_triangle(sample, 2, 0.4);
        const Box box{dvec3(-0.5, -0.4, -0.3), dvec3(0.5, 0.4, 0.3)};
        constexpr int n = 16;
        double least = infinity;
        for (int z = 0; z <= n; ++z)
            for (int y = 0; y <= n; ++y)
                for (int x = 0; x <= n; ++x)
                    least =
                        std::min(least, signed_distance(t, box.lo + box.size() * dvec3(x, y, z) / double(n)));
        // Half the diagonal of the sampling lattice.
        if (least > 0.045) CHECK_FALSE(touches(t, box));
        if (least <= 0) CHECK(touches(t, box));
        both += least <= 0;
        neither += least > 0.045;
    }
    CHECK(both > 100);
    CHECK(neither > 100);
}

TEST_CASE("a brick of beams and walls gives the minimum over all of them", "[foam_piece]") {
    for (const int count : {1, 30, 300}) {
        CAPTURE(count);
        std::vector<FoamPiece> pieces;
        for (int i = 0; i < count; ++i) {
            const RoundTriangle t = random_triangle(1000 * count + i, 5, 0.2);
            if (i % 3 == 0) {
                pieces.push_back(edge_beam(t, 0));
            } else {
                pieces.push_back(t);
            }
        }
        const Box box{dvec3(-1), dvec3(1)};
        const PieceBrick<FoamPiece> brick(box, [&](const Box& near) {
            std::vector<FoamPiece> touching;
            for (const FoamPiece& piece : pieces) {
                if (touches(piece, near)) touching.push_back(piece);
            }
            return touching;
        });
        for (int i = 0; i < 1000; ++i) {
            const CounterHash hash(14, 0, i, 0, 0);
            const dvec3 p = 2.0 * dvec3(hash.uniform(0), hash.uniform(1), hash.uniform(2)) - 1.0;
            double expected = infinity;
            for (const FoamPiece& piece : pieces) expected = std::min(expected, signed_distance(piece, p));
            REQUIRE(brick.distance(p) == expected);
        }
    }
}

}  // namespace foam_piece_test
