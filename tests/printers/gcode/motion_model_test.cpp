// The motion model against closed forms, and against a profile integrated in small steps.
#include "printers/gcode/motion_model.h"

#include <catch2/catch.hpp>
#include <numeric>
#include <random>

namespace motion_model_test {

using namespace lamella;

namespace {

double total(const std::vector<double>& seconds) {
    return std::accumulate(seconds.begin(), seconds.end(), 0.0);
}

std::vector<MotionMove> along(const std::vector<dvec2>& points, double speed, double acceleration) {
    std::vector<MotionMove> moves;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const dvec2 way = points[i] - points[i - 1];
        const dvec2 direction = way / glm::length(way);
        moves.push_back({glm::length(way), speed, acceleration, direction, direction});
    }
    return moves;
}

/// Seconds from speed v0 over v to v1, where there is room for it.
double seconds_by_hand(double length, double v, double a, double v0, double v1) {
    const double sped = (v * v - v0 * v0) / (2 * a), slowed = (v * v - v1 * v1) / (2 * a);
    REQUIRE(sped + slowed <= length);
    return (v - v0) / a + (v - v1) / a + (length - sped - slowed) / v;
}

/// Corner speeds by relaxation, then time by integration along the path.
double twin_total(const std::vector<MotionMove>& moves, double junction_deviation) {
    std::vector<double> v(moves.size() + 1, 0);
    for (std::size_t i = 1; i < moves.size(); ++i)
        v[i] = corner_speed(moves[i - 1], moves[i], junction_deviation);
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < moves.size(); ++i) {
            const double gain = 2 * moves[i].acceleration * moves[i].length;
            for (const auto& [from, to] : {std::pair(i, i + 1), std::pair(i + 1, i)}) {
                const double most = std::sqrt(v[from] * v[from] + gain);
                if (v[to] > most * (1 + 1e-12)) {
                    v[to] = most;
                    changed = true;
                }
            }
        }
    }
    double seconds = 0;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        constexpr int steps = 4000;
        const MotionMove& m = moves[i];
        const double top = m.radius > 0 ? std::min(m.speed, std::sqrt(m.acceleration * m.radius)) : m.speed;
        for (int k = 0; k < steps; ++k) {
            // Denser at the ends, where the speed may be nothing.
            const auto place = [&](double t) { return m.length * (1 - std::cos(pi * t)) / 2; };
            const double a = place(k / double{steps}), b = place((k + 1) / double{steps});
            const double s = place((k + 0.5) / steps);
            const double speed =
                std::min({top, std::sqrt(v[i] * v[i] + 2 * m.acceleration * s),
                          std::sqrt(v[i + 1] * v[i + 1] + 2 * m.acceleration * (m.length - s))});
            seconds += (b - a) / speed;
        }
    }
    return seconds;
}

}  // namespace

TEST_CASE("a single move speeds up, goes on and slows down", "[motion]") {
    const std::vector<dvec2> way{{0, 0}, {100, 0}};
    CHECK(total(move_times(along(way, 50, 1000), 0.01)) == Approx(100 / 50.0 + 50 / 1000.0));
    // Too short to come to its speed: a triangle.
    CHECK(total(move_times(along({{0, 0}, {1, 0}}, 50, 1000), 0.01)) == Approx(2 * std::sqrt(1 / 1000.0)));
    CHECK(total(move_times({}, 0.01)) == 0);
}

TEST_CASE("a straight line takes the same time in a thousand pieces", "[motion]") {
    std::vector<dvec2> pieces;
    for (int i = 0; i <= 1000; ++i) pieces.emplace_back(0.06 * i, 0.08 * i);
    CHECK(total(move_times(along(pieces, 80, 500), 0.01)) == Approx(100 / 80.0 + 80 / 500.0));
}

TEST_CASE("the corners of a square are passed at the speed that junction deviation allows", "[motion]") {
    const double a = 1500, jd = 0.02, v = 100, side = 40;
    const std::vector<dvec2> square{{0, 0}, {side, 0}, {side, side}, {0, side}, {0, 0}};
    const double sine = std::sqrt(0.5);
    const double corner = std::sqrt(a * jd * sine / (1 - sine));
    const auto seconds = move_times(along(square, v, a), jd);
    REQUIRE(seconds.size() == 4);
    CHECK(seconds[0] == Approx(seconds_by_hand(side, v, a, 0, corner)));
    CHECK(seconds[1] == Approx(seconds_by_hand(side, v, a, corner, corner)));
    CHECK(seconds[3] == Approx(seconds_by_hand(side, v, a, corner, 0)));
    // Classic jerk j takes a right angle at speed j, and so does the deviation that profiles give for it.
    const double jerk = 10, like = 0.4 * jerk * jerk / a;
    const auto moves = along(square, v, a);
    CHECK(corner_speed(moves[0], moves[1], like) == Approx(jerk).epsilon(0.02));
}

TEST_CASE("a circle of small segments is no faster than the circle", "[motion]") {
    const double a = 1000, r = 5;
    const double v = std::sqrt(a * r);
    for (const int n : {100, 1000}) {
        std::vector<dvec2> points;
        for (int i = 0; i <= 10 * n; ++i)
            points.emplace_back(r * std::cos(2 * pi * i / n), r * std::sin(2 * pi * i / n));
        const double chord = 2 * r * std::sin(pi / n), length = 10 * n * chord;
        // Each corner at the speed of the circle that touches the chords; in between there is a little to
        // gain.
        const double corner = std::sqrt(a * chord / 2 / std::tan(pi / n));
        const double between = 2 * (std::sqrt(corner * corner + a * chord) - corner) / a;
        const double seconds = total(move_times(along(points, 500, a), 1));
        CHECK(seconds == Approx(10 * n * between + corner / a).epsilon(0.001));
        CHECK(seconds == Approx(length / v + v / a).epsilon(2.0 / n));
        CHECK(total(move_times(along(points, 20, a), 0.01)) == Approx(length / 20 + 20 / a).epsilon(1e-6));
    }
    // The same as one arc.
    const MotionMove arc{2 * pi * r, 500, a, {0, 1}, {0, 1}, r};
    CHECK(total(move_times(std::vector<MotionMove>(10, arc), 0.01)) ==
          Approx(20 * pi * r / v + v / a).epsilon(1e-6));
}

TEST_CASE("machines stop before they go back and for moves of the extruder", "[motion]") {
    auto moves = along({{0, 0}, {10, 0}, {0, 0}}, 50, 1000);
    const double once = 10 / 50.0 + 50 / 1000.0;
    CHECK(total(move_times(moves, 0.01)) == Approx(2 * once));
    const MotionMove retraction{2, 20, 1000};
    moves.insert(moves.begin() + 1, retraction);
    const auto seconds = move_times(moves, 0.01);
    CHECK(seconds[0] == Approx(once));
    CHECK(seconds[1] == Approx(2 / 20.0 + 20 / 1000.0));
    CHECK(seconds[2] == Approx(once));
}

TEST_CASE("random ways take as long as their speed profile integrated", "[motion]") {
    std::mt19937 random(20240611);
    std::uniform_real_distribution<double> size(-1, 1), speed(5, 200), acceleration(200, 5000);
    for (int way = 0; way < 20; ++way) {
        CAPTURE(way);
        std::vector<MotionMove> moves;
        for (int i = 0; i < 40; ++i) {
            const double angle = size(random) * pi;
            const dvec2 direction(std::cos(angle), std::sin(angle));
            const double length = std::pow(10, 1.5 * size(random));
            moves.push_back({length, speed(random), acceleration(random), direction, direction});
            if (i % 7 == 3) moves.back().radius = length;
            if (i % 11 == 5) moves.back().in = moves.back().out = dvec2(0);
        }
        CHECK(total(move_times(moves, 0.013)) == Approx(twin_total(moves, 0.013)).epsilon(2e-3));
    }
}

TEST_CASE("the worst rate is that of the fullest window", "[motion]") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> seconds(0.001, 0.02);
    std::vector<double> times(500);
    for (double& t : times) t = seconds(random);
    double worst = 0;
    for (std::size_t i = 0; i + 16 <= times.size(); ++i)
        worst =
            std::max(worst, 16 / std::accumulate(times.begin() + static_cast<std::ptrdiff_t>(i),
                                                 times.begin() + static_cast<std::ptrdiff_t>(i) + 16, 0.0));
    RateMeter meter(16);
    for (const double t : times) meter.add(t);
    CHECK(meter.worst() == Approx(worst));
    // One that is put down and taken up again tells the same to the last bit.
    for (const std::size_t stop : {3U, 15U, 16U, 17U, 400U}) {
        RateMeter first(16), second(16);
        for (std::size_t i = 0; i < stop; ++i) first.add(times[i]);
        second.restore(first.recent(), first.worst());
        for (std::size_t i = stop; i < times.size(); ++i) second.add(times[i]);
        CHECK(second.worst() == meter.worst());
    }
    RateMeter few(16);
    for (int i = 0; i < 15; ++i) few.add(1e-6);
    CHECK(few.worst() == 0);  // the planner holds them all
}

}  // namespace motion_model_test
