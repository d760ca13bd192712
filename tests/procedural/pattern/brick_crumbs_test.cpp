// Crumbs against drawn blocks.
#include "procedural/pattern/brick_crumbs.h"

#include <catch2/catch.hpp>

#include "engine/solids/primitives.h"

namespace brick_crumbs_test {

using namespace lamella;

namespace {

/// Bricks side by side along x, void but for the samples for which `is_solid`.
template <typename IsSolid>
SurfaceBricks drawn(int count, const IsSolid& is_solid) {
    SurfaceBricks made{.spacing = 0.5, .unit = 0.1};
    for (int i = 0; i < count; ++i) {
        PatternBrick& brick = made.bricks.emplace_back();
        brick.corner = {i, 0, 0};
        for (int k = 0; k < PatternBrick::samples; ++k) {
            const glm::ivec3 at(PatternBrick::cells * i + k % PatternBrick::side,
                                k / PatternBrick::side % PatternBrick::side,
                                k / PatternBrick::side / PatternBrick::side);
            brick.steps[static_cast<std::size_t>(k)] = static_cast<std::int16_t>(is_solid(at) ? 3 : -4);
        }
    }
    return made;
}

int solid_at(const SurfaceBricks& bricks, glm::ivec3 at) {
    int steps = 0;
    for (const PatternBrick& brick : bricks.bricks) {
        const glm::ivec3 in = at - PatternBrick::cells * glm::ivec3(brick.corner);
        if (glm::clamp(in, glm::ivec3(0), glm::ivec3(PatternBrick::cells)) != in) continue;
        const int here = brick.steps[static_cast<std::size_t>(in.x + PatternBrick::side *
                                                                         (in.y + PatternBrick::side * in.z))];
        CHECK((steps == 0 || steps == here));  // copies on faces agree
        steps = here;
    }
    return steps;
}

}  // namespace

TEST_CASE("crumbs become void, also over the border of bricks, and pieces stay", "[texture]") {
    const FieldPtr body = make_box(Box{dvec3(-1), dvec3(13, 5, 5)});
    // A bar through three bricks, a crumb of 2 x 2 x 2 samples on a border, and one of a single sample.
    const auto in = [](glm::ivec3 at, glm::ivec3 lo, glm::ivec3 hi) { return glm::clamp(at, lo, hi) == at; };
    SurfaceBricks bricks = drawn(3, [&](glm::ivec3 at) {
        return in(at, {1, 1, 1}, {22, 2, 2}) || in(at, {7, 5, 5}, {8, 6, 6}) ||
               in(at, {20, 6, 6}, {20, 6, 6});
    });
    CHECK(drop_crumbs(*body, 3, 8, bricks) == 1);
    CHECK(solid_at(bricks, {7, 5, 5}) == 3);
    CHECK(drop_crumbs(*body, 3, 9, bricks) == 1);
    CHECK(solid_at(bricks, {7, 5, 5}) == -1);
    CHECK(solid_at(bricks, {8, 6, 6}) == -1);
    CHECK(solid_at(bricks, {20, 6, 6}) == -1);
    for (int x = 1; x <= 22; ++x) CHECK(solid_at(bricks, {x, 2, 1}) == 3);
    // Deeper than asked for, nothing counts.
    SurfaceBricks deep = drawn(1, [&](glm::ivec3 at) { return in(at, {4, 4, 4}, {4, 4, 4}); });
    CHECK(drop_crumbs(*body, 1, 20, deep) == 0);
}

TEST_CASE("solid outside the skin stays where it is next to a piece within", "[pattern]") {
    // The surface lies between samples 8 and 9 of x.
    const FieldPtr body = make_box(Box{dvec3(-20), dvec3(4.25, 20, 20)});
    SurfaceBricks bricks =
        drawn(2, [&](glm::ivec3 at) { return (at.y < 4 && at.x < 12) || (at.y == 7 && at.x == 9); });
    CHECK(drop_crumbs(*body, 3, 10, bricks) == 0);
    CHECK(solid_at(bricks, {9, 3, 3}) == 3);
    CHECK(solid_at(bricks, {8, 3, 3}) == 3);
    CHECK(solid_at(bricks, {9, 7, 3}) == -1);
}

}  // namespace brick_crumbs_test
