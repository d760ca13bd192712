// Beams whose radius varies, against the recursion that says what they are.
#include "procedural/foam/tapered_beams.h"

#include <catch2/catch.hpp>
#include <random>

#include "tests/engine/field/gradings.h"
#include "tests/procedural/grading/grading_checks.h"

namespace tapered_beams_test {

using namespace lamella;

namespace {

bool same(const Beam& a, const Beam& b) { return a.a == b.a && a.b == b.b && a.ra == b.ra && a.rb == b.rb; }

/// A beam and its halves, one radius at a time.
void append_by_halves(const Beam& beam, const Grading& radius, int splits, std::vector<Beam>& beams) {
    const dvec3 middle = (beam.a + beam.b) * 0.5;
    bool bends = false;
    for (const double t : {0.25, 0.5, 0.75}) {
        const double found = radius.at(t == 0.5 ? middle : beam.a + (beam.b - beam.a) * t);
        bends = bends || std::abs(found - (beam.ra + (beam.rb - beam.ra) * t)) > 0.02 * found;
    }
    if (splits == 0 || !bends) return beams.push_back(beam);
    append_by_halves({beam.a, beam.ra, middle, radius.at(middle)}, radius, splits - 1, beams);
    append_by_halves({middle, radius.at(middle), beam.b, beam.rb}, radius, splits - 1, beams);
}

/// Counts how often it is asked.
class Counted : public Grading {
  public:
    explicit Counted(GradingPtr inner) : inner_(std::move(inner)) {}
    double at(dvec3 p) const override { return ++calls, inner_->at(p); }
    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        ++calls;
        inner_->numbers(points, out);
    }
    Interval range(const Box& box) const override { return inner_->range(box); }
    mutable int calls = 0;

  private:
    GradingPtr inner_;
};

}  // namespace

TEST_CASE("beams made together are those that halving makes one by one", "[tapered_beams]") {
    const auto wavy = std::make_shared<Counted>(
        steady_function([](dvec3 p) { return 0.3 + 0.1 * std::sin(2 * p.x) * std::cos(p.y + p.z); }, 1));
    TaperedBeams tapered(NodeRadius(wavy, 0.4));
    std::mt19937 random(5);
    const Box box{dvec3(-4), dvec3(4)};
    std::vector<Beam> expected, made;
    for (const int count : {1, 0, 200}) {
        for (int i = 0; i < count; ++i) {
            const dvec3 from = checks::random_point(random, box), to = checks::random_point(random, box);
            tapered.add(from, to);
            append_by_halves({from, wavy->at(from), to, wavy->at(to)}, *wavy, 4, expected);
        }
        wavy->calls = 0;
        tapered.append(made);
        CHECK(wavy->calls <= 5);  // the ends, and one for each of four levels
    }
    CHECK(made.size() > 1000);
    CHECK(std::equal(made.begin(), made.end(), expected.begin(), expected.end(), same));
}

TEST_CASE("beams of one radius are not divided", "[tapered_beams]") {
    TaperedBeams tapered(NodeRadius(0.25));
    std::vector<Beam> made;
    tapered.add({0, 0, 0}, {1, 2, 3});
    tapered.add({4, 0, 0}, {1, 2, 3});
    tapered.append(made);
    tapered.append(made);
    REQUIRE(made.size() == 2);
    CHECK(same(made[0], {{0, 0, 0}, 0.25, {1, 2, 3}, 0.25}));
    CHECK(same(made[1], {{4, 0, 0}, 0.25, {1, 2, 3}, 0.25}));
}

}  // namespace tapered_beams_test
