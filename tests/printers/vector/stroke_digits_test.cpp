// Digits are told apart, keep to their box and draw no line twice.
#include "printers/vector/stroke_digits.h"

#include <catch2/catch.hpp>
#include <set>

namespace stroke_digits_test {

using namespace lamella;

namespace {

using Strokes = std::vector<std::vector<dvec2>>;

std::multiset<std::vector<double>> edges_of(const Strokes& strokes) {
    std::multiset<std::vector<double>> edges;
    for (const auto& stroke : strokes) {
        for (std::size_t i = 1; i < stroke.size(); ++i) {
            dvec2 a = stroke[i - 1], b = stroke[i];
            if (b.x < a.x || (b.x == a.x && b.y < a.y)) std::swap(a, b);
            edges.insert({a.x, a.y, b.x, b.y});
        }
    }
    return edges;
}

}  // namespace

TEST_CASE("every digit keeps to its box, and no stroke is drawn twice", "[digits]") {
    for (int digit = 0; digit < 10; ++digit) {
        CAPTURE(digit);
        const dvec2 center(3, -2);
        const dvec2 half = number_size(digit, 5) * 0.5;
        const Strokes strokes = number_strokes(digit, center, 5);
        REQUIRE(!strokes.empty());
        double top = -infinity, bottom = infinity;
        for (const auto& stroke : strokes) {
            REQUIRE(stroke.size() >= 2);
            for (const dvec2& p : stroke) {
                CHECK(std::abs(p.x - center.x) <= half.x + 1e-12);
                top = std::max(top, p.y);
                bottom = std::min(bottom, p.y);
            }
        }
        CHECK(top == Approx(0.5));
        CHECK(bottom == Approx(-4.5));
        const auto edges = edges_of(strokes);
        CHECK(edges.size() == std::set(edges.begin(), edges.end()).size());
    }
}

TEST_CASE("all digits differ", "[digits]") {
    std::set<std::multiset<std::vector<double>>> all;
    for (int digit = 0; digit < 10; ++digit) all.insert(edges_of(number_strokes(digit, {0, 0}, 1)));
    CHECK(all.size() == 10);
}

TEST_CASE("a number's digits stand beside each other and fill its size", "[digits]") {
    const dvec2 size = number_size(2074, 10);
    CHECK(size.y == 10);
    CHECK(size.x == Approx(10 * (3 * 0.85 + 0.6)));
    double lo = infinity, hi = -infinity;
    for (const auto& stroke : number_strokes(2074, {0, 0}, 10)) {
        for (const dvec2& p : stroke) {
            lo = std::min(lo, p.x);
            hi = std::max(hi, p.x);
        }
    }
    CHECK(lo == Approx(-size.x / 2));
    CHECK(hi == Approx(size.x / 2));
}

}  // namespace stroke_digits_test
