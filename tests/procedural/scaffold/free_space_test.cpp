// Ways beside a part are found free exactly where they are.
#include "procedural/scaffold/free_space.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/mesh/mesh_field.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/solids/shapes.h"

namespace free_space_test {

using namespace lamella;

namespace {

double min_distance(const Field& part, dvec3 a, dvec3 b) {
    double least = infinity;
    for (int k = 0; k <= 2000; ++k) least = std::min(least, part.value(a + (b - a) * (k / 2000.0)));
    return least;
}

/// The same solid, of which signs alone are known.
class SignsOnly : public Field {
  public:
    explicit SignsOnly(FieldPtr solid) : solid_(std::move(solid)) {}
    double value(dvec3 p) const override { return solid_->value(p) < 0 ? -1 : 1; }
    Metric metric() const override { return Metric::sign; }
    Box bounds() const override { return solid_->bounds(); }

  private:
    FieldPtr solid_;
};

}  // namespace

TEST_CASE("a line is clear when it keeps its distance", "[free_space]") {
    const std::vector<FieldPtr> parts{
        make_sphere({0, 0, 5}, 3),
        make_union({make_box({{-4, -1, 2}, {4, 1, 4}}), make_sphere({3, 3, 6}, 1)}),
        make_mesh_field(shapes::closed(shapes::icosphere(2, 4)))};
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-9, 9), distance(0.1, 2);
    for (const FieldPtr& part : parts) {
        const FreeSpace space(*part, -10);
        int clear = 0, blocked = 0;
        for (int k = 0; k < 300; ++k) {
            const dvec3 a(place(random), place(random), place(random));
            const dvec3 b(place(random), place(random), place(random));
            const double needed = distance(random);
            const double least = min_distance(*part, a, b);
            if (std::abs(least - needed) < 0.06) continue;
            CHECK(space.clear(a, b, needed) == (least > needed));
            (least > needed ? clear : blocked)++;
        }
        CHECK(clear > 20);
        CHECK(blocked > 20);
    }
}

TEST_CASE("what falls hits the part, passes beside it, or comes to the bed", "[free_space]") {
    const FieldPtr part = make_sphere({0, 0, 5}, 3);
    const FreeSpace space(*part, 0);
    const dvec3 down(0, 0, -1);
    const auto above = space.fall({0, 0, 20}, down, 1);
    REQUIRE(above.hits);
    CHECK(*above.hits == Approx(12).margin(0.03));
    CHECK(above.clear == Approx(11).margin(0.12));
    CHECK(above.passes);
    const auto far = space.fall({8, 0, 20}, down, 1);
    CHECK(!far.hits);
    CHECK(far.passes);
    CHECK(far.clear == Approx(20));
    const auto beside = space.fall({3.5, 0, 20}, down, 1);
    CHECK(!beside.hits);
    CHECK(!beside.passes);
}

TEST_CASE("a line may leave the part steeply, and not along it", "[free_space]") {
    const FieldPtr part = make_box({{-20, -20, 10}, {20, 20, 20}});
    const FreeSpace space(*part, 0);
    CHECK(space.clear_from_contact({0, 0, 10}, {0, 0, 5}, 1));
    CHECK(space.clear_from_contact({0, 0, 10}, {3, 0, 7}, 1));
    CHECK(!space.clear_from_contact({0, 0, 10}, {8, 0, 8}, 1));
    CHECK(space.clear_from_contact({0, 0, 10}, {0, 0, 9.5}, 1));
    CHECK(!space.clear_from_contact({0, 0, 10}, {0, 0, 15}, 1));
}

TEST_CASE("a line may begin just within a wall, and comes out of it at once", "[free_space]") {
    const FieldPtr wall = make_box({{-20, -20, 0}, {0, 20, 20}});
    const FreeSpace space(*wall, 0);
    CHECK(space.clear_from_contact({-0.2, 0, 10}, {2, 0, 7.8}, 0.5));
    CHECK_FALSE(space.clear_from_contact({-0.2, 0, 10}, {-0.2, 0, 5}, 0.5));  // stays within
    CHECK_FALSE(space.clear_from_contact({-0.2, 0, 10}, {0.2, 0, 5}, 0.5));   // comes out too late
    CHECK_FALSE(space.clear_from_contact({-0.7, 0, 10}, {2, 0, 7.3}, 0.5));   // too deep
    // What comes out must not go in again.
    const FieldPtr two = make_union({wall, make_box({{1.5, -20, 0}, {1.7, 20, 20}})});
    CHECK_FALSE(FreeSpace(*two, 0).clear_from_contact({-0.2, 0, 10}, {3, 0, 7}, 0.3));
}

TEST_CASE("a part without distances is felt for", "[free_space]") {
    const FieldPtr ball = make_sphere({0, 0, 5}, 3);
    const SignsOnly signs(ball);
    const FreeSpace space(signs, 0);
    CHECK(space.clearance({0, 0, 12}, 2) == Approx(2));
    CHECK(space.clearance({0, 0, 8.5}, 2) <= 0.5);
    CHECK(space.clearance({0, 0, 5}, 2) < 0);
    CHECK(space.clear({5, 0, 0}, {5, 0, 10}, 1.5));
    CHECK(!space.clear({4, 0, 0}, {4, 0, 10}, 1.5));
    // Close to the part, too, where a connector leaves it.
    CHECK(space.clearance({0, 0, 1.7}, 5) > 0.2);
    CHECK(space.clear_from_contact({0, 0, 2}, {0, 0, -2}, 1));
    CHECK(!space.clear_from_contact({0, 0, 2}, {0, 0, 8}, 1));
}

}  // namespace free_space_test
