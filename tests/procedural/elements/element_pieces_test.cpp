// Overlaps against closed forms; pieces that are joined, moved and dropped.
#include "procedural/elements/element_pieces.h"

#include <catch2/catch.hpp>
#include <tuple>

#include "engine/solids/primitives.h"
#include "procedural/elements/element_start.h"

namespace element_pieces_test {

using namespace lamella;

namespace {

PlacedElement upright_at(double x, double y) {
    return {.shape = 0, .at = {x, y, 0}, .turn = turn_to(dvec3(0, 1, 0))};
}

}  // namespace

TEST_CASE("overlaps are as deep as closed forms say", "[elements]") {
    const std::vector<ElementShapePtr> shapes{make_stick(10, 2), make_ring(8, 2)};
    for (const bool is_flat : {true, false}) {
        // Side by side, end to end, and a stick through a ring's hole.
        for (const double apart : {1.2, 1.9, 2.5}) {
            const Overlap beside = overlap_of(upright_at(0, 0), upright_at(apart, 0), shapes, 2, is_flat);
            CHECK(beside.depth == Approx(1 - apart / 2).margin(0.01));
            const Overlap ends = overlap_of(upright_at(0, 0), upright_at(0, 8 + apart), shapes, 2, is_flat);
            CHECK(ends.depth == Approx(1 - apart / 2).margin(0.01));
        }
        CHECK(overlap_of(upright_at(0, 0), upright_at(40, 0), shapes, 2, is_flat).depth == -infinity);
    }
    PlacedElement through{.shape = 0, .at = {0, 0, 0}, .turn = turn_to(dvec3(0, 0, 1))};
    const Overlap linked = overlap_of({.shape = 1, .at = {0, 0, 0}}, through, shapes, 2, false);
    CHECK(linked.depth == Approx(-0.5).margin(0.02));  // from 1 to 2 mm off the axis
}

TEST_CASE("loose elements are moved to the others or dropped", "[elements]") {
    const std::vector<ElementShapePtr> shapes{make_stick(10, 2)};
    const std::vector<PlacedElement> elements{upright_at(0, 0), upright_at(0, 9),     upright_at(2.6, 4),
                                              upright_at(9, 9), upright_at(2.7, -12), upright_at(4.2, -12)};
    //                                        two end to end, one 0.6 mm beside,
    //                                        one too far away, two together that carry nothing
    const std::vector<double> loads{1, 1.2, 0.4, 0.3, 0, 0.001};
    const JoinSettings settings{.hold = 0.2, .reach = 1, .idle = 0.01, .is_flat = true};
    const JoinedElements joined = join_elements(elements, loads, shapes, settings);
    CHECK(joined.pieces == 4);
    CHECK(joined.moved == 1);
    CHECK(joined.dropped == 3);
    REQUIRE(joined.elements.size() == 3);
    CHECK(joined.elements[0] == elements[0]);
    CHECK(joined.elements[2].at.x < 1.7);
    CHECK(joined.elements[2].at.x > 1.0);
    CHECK(joined.elements[2].at.y == Approx(4).margin(0.01));
    CHECK(overlap_of(joined.elements[0], joined.elements[2], shapes, 1, true).depth >= 0.2);
    // What the far one touches is what the first one touches, or another solid, from which it is not torn
    // off.
    JoinSettings touching = settings;
    touching.solids = 2;
    touching.touches = {{0, 0}, {3, 0}, {1, 1}};
    const JoinedElements together = join_elements(elements, loads, shapes, touching);
    CHECK(together.elements.size() == 4);
    CHECK(together.apart == 0);
    touching.touches = {{0, 0}, {2, 1}};
    const JoinedElements apart = join_elements(elements, loads, shapes, touching);
    CHECK(apart.moved == 0);
    CHECK(apart.elements.size() == 2);
    CHECK(apart.apart == 1);
}

TEST_CASE("elements that meet outside the body do not hold together", "[elements]") {
    const std::vector<ElementShapePtr> shapes{make_stick(10, 2)};
    // Two sticks that cross at (0, 4), of which a body leaves what is below y = 2, or below 6.
    const PlacedElement a{
        .shape = 0, .at = {-1.5, 1, 0}, .turn = turn_to(dvec3(0.4472135955, 0.894427191, 0))};
    const PlacedElement b{
        .shape = 0, .at = {1.5, 1, 0}, .turn = turn_to(dvec3(0.4472135955, -0.894427191, 0))};
    for (const bool is_flat : {true, false}) {
        const auto below = [](double y) { return make_half_space({0, 1, 0}, y); };
        CHECK(overlap_of(a, b, shapes, 1, is_flat).depth == Approx(1).margin(0.01));
        CHECK(overlap_of(a, b, shapes, 1, is_flat, below(6).get()).depth == Approx(1).margin(0.01));
        CHECK(overlap_of(a, b, shapes, 1, is_flat, below(1).get()).depth < 0);
    }
    const std::vector<double> loads{1, 1};
    const FieldPtr body = make_half_space({0, 1, 0}, 1);
    JoinSettings settings{.hold = 0.2, .reach = 0, .idle = 0.01, .is_flat = true};
    CHECK(join_elements({a, b}, loads, shapes, settings).pieces == 1);
    settings.body = body.get();
    CHECK(join_elements({a, b}, loads, shapes, settings).pieces == 2);
}

TEST_CASE("gaps are closed by the shortest bridges", "[elements]") {
    const std::vector<ElementShapePtr> shapes{make_stick(10, 2)};
    // Side by side, gaps of 0.6, 0.8 and 3 mm, and one that carries nothing.
    const std::vector<PlacedElement> elements{upright_at(0, 0), upright_at(2.6, 0), upright_at(5.4, 0),
                                              upright_at(10.4, 0), upright_at(-2.6, 0)};
    const std::vector<double> loads{1, 1, 1, 1, 0};
    for (const bool is_flat : {true, false}) {
        const JoinedElements joined =
            join_elements(elements, loads, shapes,
                          {.hold = 0.2, .reach = 1, .bridge = 0.5, .idle = 0.01, .is_flat = is_flat});
        CHECK(joined.pieces == 5);
        CHECK(joined.moved == 0);
        CHECK(joined.dropped == 2);
        CHECK(joined.elements == std::vector(elements.begin(), elements.begin() + 3));
        REQUIRE(joined.bridges.size() == 2);
        // From a quarter of a millimetre inside one to as far inside the other.
        for (const auto& [bridge, left, gap] :
             {std::tuple(joined.bridges[0], 1.0, 0.6), {joined.bridges[1], 3.6, 0.8}}) {
            CHECK(std::min(bridge.from.x, bridge.to.x) == Approx(left - 0.25).margin(0.02));
            CHECK(std::max(bridge.from.x, bridge.to.x) == Approx(left + gap + 0.25).margin(0.02));
            CHECK(bridge.from.y == Approx(bridge.to.y).margin(0.05));
        }
    }
}

}  // namespace element_pieces_test
