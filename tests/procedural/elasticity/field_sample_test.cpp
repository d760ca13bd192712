// Elements against the field's own values.
#include "procedural/elasticity/field_sample.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/solids/primitives.h"
#include "procedural/foam/voronoi_foam.h"

namespace field_sample_test {

using namespace lamella;

namespace {

std::size_t count(const ElementMask& sample) {
    std::size_t sum = 0;
    for (const std::uint8_t p : sample.present) sum += p;
    return sum;
}

int difference(const ElementMask& a, const ElementMask& b) {
    int differ = 0;
    for (std::size_t i = 0; i < a.present.size(); ++i) differ += a.present[i] != b.present[i];
    return differ;
}

FoamSettings repeating(std::uint64_t seed, SeedPattern pattern = SeedPattern::jittered) {
    FoamSettings settings;
    settings.cell = 1.0;
    settings.beam_radius = 0.12;
    settings.seed = seed;
    settings.pattern = pattern;
    settings.repeats_after = 1;
    settings.region = {dvec3(-12), dvec3(22)};
    return settings;
}

}  // namespace

TEST_CASE("cuboid elements divide a box whose sides no cube divides", "[elasticity]") {
    const Box box{{-1, 2, 3}, {2, 4.1, 4}};
    const FieldPtr ball = make_sphere({0.5, 3, 3.5}, 0.93);
    const glm::ivec3 size(24, 16, 7);
    const ElementMask sample = sample_field(*ball, box, size);
    int differ = 0, solid = 0;
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const dvec3 middle = box.lo + (dvec3(x, y, z) + 0.5) * box.size() / dvec3(size);
                if (std::abs(ball->value(middle)) <= 0.001) continue;
                differ += sample.at(x, y, z) != (ball->value(middle) < 0);
                solid += sample.at(x, y, z);
            }
        }
    }
    CHECK(differ == 0);
    CHECK(solid > 1000);
}

TEST_CASE("an element is there where its middle is solid", "[elasticity]") {
    const Box box{{-1, 2, 3}, {2, 4, 4}};
    const FieldPtr ball = make_sphere({0.5, 3, 3.5}, 0.93);
    const ElementMask sample = sample_field(*ball, box, 24);
    REQUIRE(sample.size == glm::ivec3(24, 16, 8));
    int differ = 0;
    for (int z = 0; z < 8; ++z) {
        for (int y = 0; y < 16; ++y) {
            for (int x = 0; x < 24; ++x) {
                const dvec3 middle = box.lo + (dvec3(x, y, z) + 0.5) * 0.125;
                if (std::abs(ball->value(middle)) > 0.001)
                    differ += sample.at(x, y, z) != (ball->value(middle) < 0);
            }
        }
    }
    CHECK(differ == 0);
    CHECK(sample_field(*ball, box, glm::ivec3(24, 16, 8)).present == sample.present);
    CHECK_THROWS_AS(sample_field(*ball, {}, 8), InputError);
    CHECK_THROWS_AS(sample_field(*ball, box, glm::ivec3(24, 0, 8)), InputError);
    CHECK_THROWS_AS(sample_field(*ball, box, 0), InputError);
    CHECK_THROWS_AS(sample_field(*ball, box, 5000), InputError);
}

TEST_CASE("a foam that repeats is the same a period further along every axis", "[elasticity]") {
    for (const SeedPattern pattern : {SeedPattern::jittered, SeedPattern::bcc}) {
        const FoamSettings settings = repeating(3, pattern);
        const double period = prepare_foam(settings).tree->coarse_side();
        CAPTURE(static_cast<int>(pattern), period);
        const auto foam = make_voronoi_foam(settings);
        const auto cube = [&](dvec3 lo) { return Box{lo, lo + period}; };
        const ElementMask sample = sample_field(*foam, cube(dvec3(0)), 32);
        CHECK(count(sample) > 1000);
        for (const dvec3 way : {dvec3(1, 0, 0), dvec3(0, -1, 0), dvec3(0, 0, 1), dvec3(-2, 3, 1)})
            CHECK(difference(sample_field(*foam, cube(way * period), 32), sample) == 0);
        // Moved by half of it, what goes out at one side comes in at the other.
        const ElementMask half = sample_field(*foam, cube({period / 2, 0, 0}), 32);
        int differ = 0;
        for (int z = 0; z < 32; ++z) {
            for (int y = 0; y < 32; ++y) {
                for (int x = 0; x < 32; ++x) differ += half.at(x, y, z) != sample.at((x + 16) % 32, y, z);
            }
        }
        CHECK(differ == 0);
    }
}

TEST_CASE("a foam that repeats is another one by another seed, and none where nobody asks", "[elasticity]") {
    const auto elements = [](const FoamSettings& settings) {
        return sample_field(*make_voronoi_foam(settings), {dvec3(0), dvec3(4)}, 32).present;
    };
    FoamSettings free = repeating(3);
    free.repeats_after = 0;
    CHECK(elements(repeating(3)) != elements(repeating(4)));
    const auto foam = make_voronoi_foam(free);
    CHECK(sample_field(*foam, {dvec3(4, 0, 0), dvec3(8, 4, 4)}, 32).present !=
          sample_field(*foam, {dvec3(0), dvec3(4)}, 32).present);
}

TEST_CASE("sampling stops within a few planes", "[elasticity]") {
    /// Asks to stop when its third slice is made.
    class Stopping : public Field {
      public:
        explicit Stopping(CancelToken& cancel) : cancel_(cancel) {}
        double value(dvec3 p) const override { return ball_->value(p); }
        Interval range(const Box& box) const override { return ball_->range(box); }
        Metric metric() const override { return ball_->metric(); }
        Box bounds() const override { return ball_->bounds(); }
        const SliceField& slice(SliceContext& context, double z) const override {
            if (++slices == 3) cancel_.cancel();
            return ball_->slice(context, z);
        }
        mutable std::atomic<int> slices{0};

      private:
        CancelToken& cancel_;
        FieldPtr ball_ = make_sphere(dvec3(0), 1);
    };
    CancelToken cancel;
    const Stopping field(cancel);
    CHECK_THROWS_AS(sample_field(field, {dvec3(-1), dvec3(1)}, 512, &cancel), Interrupted);
    // Planes under way in other threads are finished.
    CHECK(field.slices < 100);
}

}  // namespace field_sample_test
