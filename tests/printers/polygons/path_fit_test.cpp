// Merged points and arcs against the polylines that they stand for.
#include "printers/polygons/path_fit.h"

#include <catch2/catch.hpp>
#include <random>

namespace path_fit_test {

using namespace lamella;

namespace {

constexpr double unit = 0.001;

/// Points along the pieces, densely.
std::vector<dvec2> walk(dvec2 from, const std::vector<PathPiece>& pieces) {
    std::vector<dvec2> out{from};
    for (const PathPiece& piece : pieces) {
        const int steps = std::max(1, static_cast<int>(std::ceil(piece.length / 0.02)));
        const dvec2 arm = from - piece.center, end = piece.to - piece.center;
        double sweep = 0;
        if (piece.turn != 0) {
            sweep = std::atan2(cross(arm, end), glm::dot(arm, end));
            if (sweep * piece.turn < 0) sweep += 2 * pi * piece.turn;
            CHECK(piece.length == Approx(std::abs(sweep) * glm::length(arm)).epsilon(0.01));
        }
        for (int i = 1; i < steps; ++i) {
            const double t = static_cast<double>(i) / steps;
            const double c = std::cos(t * sweep), s = std::sin(t * sweep);
            out.push_back(piece.turn == 0
                              ? from + (piece.to - from) * t
                              : piece.center + dvec2(c * arm.x - s * arm.y, s * arm.x + c * arm.y));
        }
        out.push_back(piece.to);
        from = piece.to;
    }
    return out;
}

double distance_to(dvec2 p, const std::vector<dvec2>& line) {
    double least = 1e9;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const dvec2 way = line[i + 1] - line[i];
        const double square = glm::dot(way, way);
        const double t = square > 0 ? std::clamp(glm::dot(p - line[i], way) / square, 0.0, 1.0) : 0;
        least = std::min(least, glm::distance(p, line[i] + way * t));
    }
    return least;
}

/// The farthest that either lies from the other.
double deviation(const std::vector<dvec2>& points, const std::vector<PathPiece>& pieces) {
    const std::vector<dvec2> walked = walk(points.front(), pieces);
    double most = 0;
    for (const dvec2 p : walked) most = std::max(most, distance_to(p, points));
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        for (const double t : {0.0, 0.25, 0.5, 0.75})
            most = std::max(most, distance_to(points[i] + (points[i + 1] - points[i]) * t, walked));
    }
    return most;
}

double length_of(const std::vector<dvec2>& points) {
    double sum = 0;
    for (std::size_t i = 1; i < points.size(); ++i) sum += glm::distance(points[i - 1], points[i]);
    return sum;
}

double run_of(const std::vector<PathPiece>& pieces) {
    double sum = 0;
    for (const PathPiece& piece : pieces) sum += piece.run;
    return sum;
}

std::vector<dvec2> circle(dvec2 center, double radius, double from, double to, int count) {
    std::vector<dvec2> points;
    for (int i = 0; i <= count; ++i) {
        const double angle = from + (to - from) * i / count;
        points.push_back(center + radius * dvec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

/// A closed curve with bulges and ripples.
std::vector<dvec2> blob(unsigned seed, int count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> phase(0, 2 * pi), height(0, 1);
    double phases[6], heights[6];
    for (int k = 0; k < 6; ++k) {
        phases[k] = phase(random);
        heights[k] = height(random) / (k + 1) / (k + 1);
    }
    std::vector<dvec2> points;
    for (int i = 0; i <= count; ++i) {
        const double angle = 2 * pi * (i % count) / count;
        double radius = 8;
        for (int k = 0; k < 6; ++k) radius += heights[k] * std::cos((k + 2) * angle + phases[k]);
        points.push_back(dvec2(100, 90) + radius * dvec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

}  // namespace

TEST_CASE("points that are left out lie within the tolerance", "[path_fit]") {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        for (const double tolerance : {0.003, 0.02, 0.2}) {
            CAPTURE(seed, tolerance);
            const auto points = blob(seed, 700);
            const auto pieces = merged_pieces(points, tolerance);
            CHECK(deviation(points, pieces) <= tolerance + 1e-9);
            CHECK(pieces.size() < points.size() / 2);
            CHECK(pieces.back().to == points.back());
            CHECK(run_of(pieces) == Approx(length_of(points)));
        }
    }
    CHECK(merged_pieces(std::vector<dvec2>{{0, 0}, {1, 0}, {2, 0}, {9, 0}}, 1e-6).size() == 1);
    CHECK(merged_pieces(std::vector<dvec2>{{0, 0}}, 0.1).empty());
    // A loop smaller than the tolerance has the length of its way there and back.
    const auto loop =
        merged_pieces(std::vector<dvec2>{{0, 0}, {0.02, 0}, {0.02, 0.02}, {0, 0.02}, {0, 0}}, 0.1);
    REQUIRE(loop.size() == 2);
    for (const PathPiece& piece : loop) CHECK(piece.length == Approx(0.02 * std::sqrt(2.0)));
    // Out and back again: the turning point stays, though it lies on the line through the others.
    const std::vector<dvec2> back{{0, 0}, {5, 0}, {1, 0}};
    CHECK(merged_pieces(back, 0.1).size() == 2);
}

TEST_CASE("a circle's points become arcs that turn its way", "[path_fit]") {
    for (const int turn : {1, -1}) {
        const auto points = circle({50, 60}, 10, 0.3, 0.3 + turn * 2 * pi, 200);
        const auto pieces = arc_pieces(points, 0.01, false, unit);
        CHECK(pieces.size() <= 5);
        for (const PathPiece& piece : pieces) {
            if (piece.run < 1) continue;  // what is left over
            CHECK(piece.turn == turn);
            CHECK(glm::distance(piece.center, dvec2(50, 60)) < 0.02);
            CHECK(piece.length <= pi * 10 * 1.01);
        }
        CHECK(deviation(points, pieces) <= 0.01 + 2 * unit);
        CHECK(run_of(pieces) == Approx(length_of(points)));
    }
}

TEST_CASE("arcs lie within the tolerance of any curve", "[path_fit]") {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        for (const double tolerance : {0.005, 0.025, 0.1}) {
            for (const bool merge : {false, true}) {
                CAPTURE(seed, tolerance, merge);
                const auto points = blob(seed, 500);
                const auto pieces = arc_pieces(points, tolerance, merge, unit);
                CHECK(deviation(points, pieces) <= tolerance + 2 * unit);
                CHECK(run_of(pieces) == Approx(length_of(points)));
                CHECK(pieces.size() < points.size() / 4);
                CHECK(pieces.back().to == points.back());
            }
        }
    }
}

TEST_CASE("corners and straight lines do not become arcs", "[path_fit]") {
    std::vector<dvec2> zigzag, line, square;
    for (int i = 0; i < 30; ++i) {
        zigzag.emplace_back(i, i % 2);
        line.emplace_back(0.7 * i, 0.3 * i);
    }
    for (const dvec2 corner : {dvec2(0, 0), dvec2(10, 0), dvec2(10, 10), dvec2(0, 10), dvec2(0, 0)})
        square.push_back(corner);
    for (const auto& points : {zigzag, line, square}) {
        const auto pieces = arc_pieces(points, 0.02, false, unit);
        CHECK(pieces.size() == points.size() - 1);
        for (const PathPiece& piece : pieces) CHECK(piece.turn == 0);
    }
    // A square with round corners: four arcs, four sides.
    std::vector<dvec2> round;
    for (int k = 0; k < 4; ++k) {
        const dvec2 center = 10.0 * dvec2(k == 0 || k == 3 ? 1 : -1, k < 2 ? 1 : -1);
        for (const dvec2 p : circle(center, 3, k * pi / 2, (k + 1) * pi / 2, 20)) round.push_back(p);
    }
    round.push_back(round.front());
    const auto pieces = arc_pieces(round, 0.005, true, unit);
    CHECK(pieces.size() == 8);
    CHECK(deviation(round, pieces) <= 0.005 + 2 * unit);
}

}  // namespace path_fit_test
