// Runs found by walking a line, against functions whose zeros are known.
#include "procedural/lattice/line_walk.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

namespace line_walk_test {

using namespace lamella;

namespace {

/// The same function along each line, shifted by as much as the line says.
template <typename Value>
class Shifted : public LineFunction {
  public:
    Shifted(const Value& value, double steepest, double shift)
        : value_(value), steepest_(steepest), shift_(shift) {}
    void values(std::span<const LinePoint> points, std::span<double> out) const override {
        for (std::size_t i = 0; i < points.size(); ++i)
            out[i] = value_(points[i].u + shift_ * static_cast<double>(points[i].line));
    }
    double steepest(std::size_t /*line*/) const override { return steepest_; }

  private:
    const Value& value_;
    double steepest_, shift_;
};

template <typename Value>
std::vector<Run> walk(const Value& value, double steepest, int lo, int hi) {
    RunRows out;
    walk_lines(Shifted(value, steepest, 0), 1, lo * run_unit, hi * run_unit, out);
    REQUIRE(out.lines() == 1);
    return {out.runs().begin(), out.runs().end()};
}

/// The least distance to a random set of thick points, less their half width: 1-Lipschitz.
struct Beads {
    std::vector<Run> beads;
    explicit Beads(unsigned seed) {
        std::mt19937 random(seed);
        std::uniform_int_distribution<int> gap(70, 9000), width(70, 3000);
        for (int u = -4000; u < 60 * run_unit;) {
            const int begin = u + gap(random), end = begin + width(random);
            beads.push_back({begin, end});
            u = end;
        }
    }
    double operator()(double u) const {
        double least = infinity;
        for (const Run& bead : beads) {
            const double middle = (bead.begin + bead.end) * 0.5, half = (bead.end - bead.begin) * 0.5;
            least = std::min(least, std::abs(u - middle) - half);
        }
        return least;
    }
};

}  // namespace

TEST_CASE("a walk finds all that is wider than a quarter pixel, to the unit", "[line_walk]") {
    for (unsigned seed = 1; seed < 30; ++seed) {
        INFO("seed " << seed);
        const Beads beads(seed);
        std::vector<Run> expected;
        for (const Run& bead : beads.beads) {
            const Run cut{std::max(bead.begin, 3 * run_unit), std::min(bead.end, 50 * run_unit)};
            if (cut.begin < cut.end) expected.push_back(cut);
        }
        CHECK(walk(beads, 1, 3, 50) == expected);
    }
}

TEST_CASE("a walk that knows where its function is monotone finds the same in fewer points", "[line_walk]") {
    /// A sine with a slow drift; where the sine is steeper than the drift, it is monotone.
    class Known : public LineFunction {
      public:
        explicit Known(bool tells) : tells_(tells) {}
        void values(std::span<const LinePoint> points, std::span<double> out) const override {
            count += points.size();
            for (std::size_t i = 0; i < points.size(); ++i)
                out[i] = std::sin(points[i].u / 4000) + 0.00003 * points[i].u - 0.5;
        }
        double steepest(std::size_t /*line*/) const override { return 1.0 / 4000 + 0.00003; }
        bool is_monotone(std::size_t /*line*/, double u0, double u1) const override {
            const double half_wave = std::floor(u0 / 4000 / pi - 0.5);
            return tells_ && std::floor(u1 / 4000 / pi - 0.5) == half_wave &&
                   std::min(std::abs(std::cos(u0 / 4000)), std::abs(std::cos(u1 / 4000))) / 4000 > 0.00003;
        }
        mutable std::size_t count = 0;

      private:
        bool tells_;
    };
    const Known silent(false), telling(true);
    RunRows without, with;
    walk_lines(silent, 2, 0, 300 * run_unit, without);
    walk_lines(telling, 2, 0, 300 * run_unit, with);
    CHECK(without.runs().size() > 4);
    CHECK(std::ranges::equal(without.runs(), with.runs()));
    CHECK(with.lines() == without.lines());
    CHECK(telling.count * 10 < silent.count * 7);
}

TEST_CASE("what a walk finds does not depend on where it begins and ends", "[line_walk]") {
    const auto wave = [](double u) { return std::sin(u / 301) + std::cos(u / 97) - 0.3; };
    const auto whole = walk(wave, 0.02, 0, 200);
    for (const int lo : {0, 1, 7, 8, 33, 150}) {
        for (const int hi : {151, 168, 199}) {
            std::vector<Run> expected;
            for (const Run& run : whole) {
                const Run cut{std::max(run.begin, lo * run_unit), std::min(run.end, hi * run_unit)};
                if (cut.begin < cut.end) expected.push_back(cut);
            }
            CHECK(walk(wave, 0.02, lo, hi) == expected);
        }
    }
}

TEST_CASE("a walk takes what is not a number for outside, and ends at jumps", "[line_walk]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto half = [&](double u) { return u < 1000 ? nan : -1.0; };
    const auto found = walk(half, 1, 0, 20);
    REQUIRE(found.size() == 1);
    CHECK(std::abs(found[0].begin - 1000) <= 1);
    CHECK(found[0].end == 20 * run_unit);
    CHECK(walk([&](double) { return nan; }, 1, 0, 20).empty());
    CHECK(walk([](double) { return -1.0; }, 1, -3, 20) == std::vector<Run>{{-3 * run_unit, 20 * run_unit}});
    CHECK(walk([](double) { return -1.0; }, 1, 5, 5).empty());
}

TEST_CASE("many lines are each walked as if alone", "[line_walk]") {
    const auto wave = [](double u) { return std::sin(u / 301) + std::cos(u / 97) - 0.3; };
    // So many and so long that they are walked in several turns.
    constexpr std::size_t count = 700;
    constexpr int hi = 400;
    constexpr double shift = 37;
    RunRows out;
    walk_lines(Shifted(wave, 0.02, shift), count, 0, hi * run_unit, out);
    REQUIRE(out.lines() == count);
    for (std::size_t l = 0; l < count; ++l) {
        const auto alone = [&](double u) { return wave(u + shift * static_cast<double>(l)); };
        const auto line = out.line(l);
        CHECK(std::vector<Run>(line.begin(), line.end()) == walk(alone, 0.02, 0, hi));
    }
    RunRows none;
    walk_lines(Shifted(wave, 0.02, shift), 0, 0, hi * run_unit, none);
    CHECK(none.lines() == 0);
}

}  // namespace line_walk_test
