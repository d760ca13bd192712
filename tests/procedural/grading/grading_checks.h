// Checks that every grading has to pass.
#pragma once

#include <bit>
#include <catch2/catch.hpp>
#include <random>

#include "engine/field/grading.h"

namespace lamella::checks {

inline dvec3 random_point(std::mt19937& random, const Box& box) {
    std::uniform_real_distribution<double> unit(0, 1);
    const double x = unit(random), y = unit(random), z = unit(random);
    return box.lo + box.size() * dvec3(x, y, z);
}

/// Whether numbers asked for together are those asked for one by one, to the last bit.
inline void check_numbers(const Grading& grading, std::span<const dvec3> points) {
    std::vector<double> together(points.size(), -7);
    grading.numbers(points, together);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double alone = grading.at(points[i]);
        if (std::isnan(alone) && std::isnan(together[i])) continue;
        if (std::bit_cast<std::uint64_t>(alone) != std::bit_cast<std::uint64_t>(together[i]))
            FAIL(together[i] << " together with others, " << alone << " alone");
    }
}

/// How much wider the range of a box is than the numbers found at `points` places in it; fails when one of
/// them is outside.
inline double excess(const Grading& grading, const Box& box, std::mt19937& random, int points) {
    const Interval range = grading.range(box);
    Interval found;
    std::vector<dvec3> asked;
    for (int i = 0; i < points + 8; ++i) {
        dvec3 p = random_point(random, box);
        if (i < 8) {
            p = {(i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y,
                 (i & 4) != 0 ? box.hi.z : box.lo.z};
        }
        asked.push_back(p);
        const double number = grading.at(p);
        if (std::isnan(number)) {
            if (range.hi != infinity) FAIL("a NaN within a range that ends at " << range.hi);
            continue;
        }
        if (!range.contains(number)) {
            FAIL(number << " at " << p.x << " " << p.y << " " << p.z << " lies outside " << range.lo << " to "
                        << range.hi);
        }
        found = {std::min(found.lo, number), std::max(found.hi, number)};
    }
    check_numbers(grading, asked);
    return range.width() - found.width();
}

/// Asks for the ranges of boxes from the whole of `within` down to a billionth, and of flat ones, at 10^4
/// points in all.
inline void check_ranges(const Grading& grading, const Box& within, unsigned seed = 1) {
    std::mt19937 random(seed);
    for (int round = 0; round < 200; ++round) {
        const double shrink = std::pow(0.1, round % 10);
        const dvec3 at = random_point(random, within);
        dvec3 half = (random_point(random, within) - within.lo) * (shrink / 2);
        if (round % 3 == 1) half[round % 9 / 3] = 0;
        excess(grading, {at - half, at + half}, random, 50);
    }
}

}  // namespace lamella::checks
