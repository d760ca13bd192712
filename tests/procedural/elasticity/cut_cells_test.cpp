// The share of a foam's modulus below a face that cuts its cells.
#include "procedural/elasticity/cut_cells.h"

#include <catch2/catch.hpp>

namespace cut_cells_test {

using namespace lamella;

TEST_CASE("a foam below a bare face lacks the modulus of a layer of cut cells", "[cut_cells]") {
    for (const double ratio : {0.05, 0.1, 0.2}) {
        // All that is missing, in a thick plate: the length of the boundary layer.
        const double length = 2.5 * (0.36 - 1.2 * ratio), thick = 100;
        CHECK((1 - cut_cells_share({0, thick}, 2.5, ratio)) * thick == Approx(length).epsilon(1e-9));
        CHECK(cut_cells_share({cut_cells_depth(2.5), thick}, 2.5, ratio) > 0.99);
        CHECK(cut_cells_share({0, 0}, 2.5, ratio) == Approx(0).margin(1e-12));
    }
    // Beams that leave little void have no loose ends.
    CHECK(cut_cells_share({0, 0.1}, 2.5, 0.31) == 1);
}

TEST_CASE("the share of an element is the mean of those of its parts", "[cut_cells]") {
    double sum = 0;
    constexpr int parts = 1000;
    for (int i = 0; i < parts; ++i) {
        const double depth = 0.2 + 0.5 * (i + 0.5) / parts;
        sum += cut_cells_share({depth, depth}, 2, 0.12);
    }
    CHECK(cut_cells_share({0.2, 0.7}, 2, 0.12) == Approx(sum / parts).epsilon(1e-6));
    double last = 0;
    for (double depth = 0; depth < 3; depth += 0.1) {
        const double share = cut_cells_share({depth, depth + 0.1}, 2, 0.12);
        CHECK(share > last);
        last = share;
    }
    CHECK(cut_cells_share({-0.1, 0.1}, 2, 0.12) == cut_cells_share({0, 0.1}, 2, 0.12));
}

}  // namespace cut_cells_test
