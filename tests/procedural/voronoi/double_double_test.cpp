// Double-double arithmetic keeps what doubles lose.
#include "procedural/voronoi/double_double.h"

#include <catch2/catch.hpp>

namespace double_double_test {

using namespace lamella;

TEST_CASE("products and sums keep the digits that doubles drop", "[double_double]") {
    // (1 + e)(1 - e) - 1 = -e^2, which a double rounds to nothing.
    const double e = 0x1p-30;
    const DoubleDouble difference = DoubleDouble{1 + e} * DoubleDouble{1 - e} - DoubleDouble{1};
    CHECK(difference.hi == -e * e);
    CHECK(difference.lo == 0);

    const DoubleDouble sum = (DoubleDouble{1e20} + DoubleDouble{1}) - DoubleDouble{1e20};
    CHECK(sum.hi == 1);

    const DoubleDouble third{1.0 / 3, (1 - 3 * (1.0 / 3 * 1)) / 3};
    const DoubleDouble square = two_product(1.0 / 3, 1.0 / 3);
    const long double exact = static_cast<long double>(1.0 / 3) * static_cast<long double>(1.0 / 3);
    CHECK(square.hi == 1.0 / 3 * (1.0 / 3));
    CHECK(static_cast<long double>(square.hi) + static_cast<long double>(square.lo) ==
          Approx(static_cast<double>(exact)).epsilon(1e-18));
    CHECK((third * DoubleDouble{3}).hi == 1);
}

}  // namespace double_double_test
