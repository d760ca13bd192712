// Set operations on runs against bit arrays.
#include "engine/runs/runs.h"

#include <catch2/catch.hpp>
#include <random>

namespace runs_test {

using namespace lamella;

namespace {

constexpr int width = 200;
using Bits = std::vector<bool>;

Bits bits_of(std::span<const Run> line) {
    Bits bits(width);
    for (const Run& run : line) {
        for (int u = run.begin; u < run.end; ++u) bits[static_cast<std::size_t>(u)] = true;
    }
    return bits;
}

RunRows random_rows(std::mt19937& random, int lines) {
    RunRows rows;
    std::uniform_int_distribution<int> step(0, 12);
    for (int l = 0; l < lines; ++l) {
        for (int u = step(random); u < width - 13;) {
            const int end = u + step(random);
            rows.push(u, end);
            u = end + step(random);
        }
        rows.end_line();
    }
    return rows;
}

void check_canonical(const RunRows& rows) {
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        int last = -1;
        for (const Run& run : rows.line(l)) {
            REQUIRE(run.begin < run.end);
            REQUIRE(run.begin > last);
            last = run.end;
        }
    }
}

}  // namespace

TEST_CASE("set operations on runs equal set operations on bits") {
    const unsigned seed = 7;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    for (int round = 0; round < 50; ++round) {
        const RunRows a = random_rows(random, 8), b = random_rows(random, 8);
        RunRows all, both, rest;
        unite(a, b, all);
        intersect(a, b, both);
        subtract(a, b, rest);
        for (const RunRows* rows : {&all, &both, &rest}) check_canonical(*rows);
        for (std::size_t l = 0; l < 8; ++l) {
            const Bits x = bits_of(a.line(l)), y = bits_of(b.line(l));
            const Bits u = bits_of(all.line(l)), i = bits_of(both.line(l)), s = bits_of(rest.line(l));
            for (std::size_t k = 0; k < width; ++k) {
                REQUIRE(u[k] == (x[k] || y[k]));
                REQUIRE(i[k] == (x[k] && y[k]));
                REQUIRE(s[k] == (x[k] && !y[k]));
            }
        }
    }
}

TEST_CASE("runs that meet are joined, empty ones vanish") {
    RunRows rows;
    rows.push(0, 10);
    rows.push(10, 20);
    rows.push(20, 20);
    rows.push(30, 25);
    rows.push(40, 50);
    rows.end_line();
    REQUIRE(rows.line(0).size() == 2);
    REQUIRE(rows.line(0)[0] == Run{0, 20});
    REQUIRE(rows.total_length() == 30);
}

TEST_CASE("lines appended at once are the lines appended one by one") {
    std::mt19937 random(7);
    const RunRows rows = random_rows(random, 20), more = random_rows(random, 30);
    RunRows at_once = rows, one_by_one = rows;
    at_once.append_lines(more, 4, 17);
    at_once.append_lines(more, 30, 0);
    at_once.append_lines(more);
    for (std::size_t l = 4; l < 21; ++l) one_by_one.append_line(more.line(l));
    for (std::size_t l = 0; l < 30; ++l) one_by_one.append_line(more.line(l));
    CHECK(at_once == one_by_one);
    at_once.push(1, 2);  // a line that follows is a line of its own
    at_once.end_line();
    CHECK(at_once.lines() == 68);
    CHECK(at_once.line(67).size() == 1);
    CHECK(at_once.line(66).size() == more.line(29).size());
}

TEST_CASE("lines lie at the same place however the rows are split into bands") {
    const RowBand whole{Axis::x, 1.5, 0.025, -3.25, 0.05, 0, 640, 4, 0, 100};
    RowBand part = whole;
    part.first = 64;
    part.count = 64;
    for (int l = 0; l < part.lines(); ++l) REQUIRE(part.line(l) == whole.line(64 * 4 + l));
    REQUIRE(whole.line(0) == Approx(-3.25 + 0.05 / 8));
}

TEST_CASE("a band with a step holds the lines whose numbers are multiples of it") {
    const int sub = 4, first = -9, count = 31;
    const RowBand whole{Axis::x, 1.5, 0.025, -3.25, -0.05, first, count, sub, 0, 100};
    for (const int step : {1, 2, 3, 4, 5, 13, 400}) {
        RowBand band = whole;
        band.step = step;
        std::vector<int> expected;
        for (int n = first * sub; n < (first + count) * sub; ++n) {
            if (n % step == 0) expected.push_back(n);
        }
        REQUIRE(band.lines() == static_cast<int>(expected.size()));
        for (int l = 0; l < band.lines(); ++l) {
            const int n = expected[static_cast<std::size_t>(l)];
            REQUIRE(band.number(l) == n);
            REQUIRE(band.line(l) == whole.line(n - first * sub));
        }
        CHECK(band.line_pitch() == Approx(-0.05 / sub * step));
    }
}

}  // namespace runs_test
