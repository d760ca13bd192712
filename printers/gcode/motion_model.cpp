// Limits the corner speeds in two passes, then computes each move's duration in closed form.
#include "printers/gcode/motion_model.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

/// Returns the highest speed within a move.
double max_speed(const MotionMove& move) {
    return move.radius > 0 ? std::min(move.speed, std::sqrt(move.acceleration * move.radius)) : move.speed;
}

/// Returns the speed after accelerating from `speed` along the move.
double reachable(double speed, const MotionMove& move) {
    return std::sqrt(speed * speed + 2 * move.acceleration * move.length);
}

/// Returns the duration of a move from one speed to another, s, accelerating in between as far as possible.
double trapezoid(const MotionMove& move, double from, double to) {
    const double a = move.acceleration;
    const double most = max_speed(move);
    const double speeding = (most * most - from * from) / (2 * a);
    const double slowing = (most * most - to * to) / (2 * a);
    if (speeding + slowing <= move.length) {
        return (2 * most - from - to) / a + (move.length - speeding - slowing) / most;
    }
    const double peak = std::sqrt(a * move.length + (from * from + to * to) / 2);
    return std::max(0.0, 2 * peak - from - to) / a;
}

}  // namespace

double corner_speed(const MotionMove& before, const MotionMove& after, double junction_deviation) {
    constexpr double straight = 1e-9;
    const double product = before.out.x * after.in.x + before.out.y * after.in.y;
    const bool stands = before.out == dvec2(0) || after.in == dvec2(0);
    const double most = std::min(max_speed(before), max_speed(after));
    if (stands || product <= -1 + straight) return 0;
    if (product >= 1 - straight) return most;
    // Sine and cosine of half the angle between the two legs, as in grbl: 180 degrees is straight on, 0 a
    // reversal.
    const double sine = std::sqrt((1 + product) / 2), cosine = std::sqrt((1 - product) / 2);
    const double acceleration = std::min(before.acceleration, after.acceleration);
    double square = acceleration * junction_deviation * sine / (1 - sine);
    for (const MotionMove* leg : {&before, &after}) {
        // The tangent arc covers at most half of a leg.
        if (leg->radius == 0) square = std::min(square, acceleration * leg->length / 2 * sine / cosine);
    }
    return std::min(most, std::sqrt(square));
}

std::vector<double> move_times(std::span<const MotionMove> moves, double junction_deviation) {
    const std::size_t n = moves.size();
    std::vector<double> corners(n + 1, 0);
    for (std::size_t i = 1; i < n; ++i) corners[i] = corner_speed(moves[i - 1], moves[i], junction_deviation);
    for (std::size_t i = n; i-- > 0;) corners[i] = std::min(corners[i], reachable(corners[i + 1], moves[i]));
    for (std::size_t i = 0; i < n; ++i)
        corners[i + 1] = std::min(corners[i + 1], reachable(corners[i], moves[i]));
    std::vector<double> times(n);
    for (std::size_t i = 0; i < n; ++i) times[i] = trapezoid(moves[i], corners[i], corners[i + 1]);
    return times;
}

void RateMeter::add(double seconds) {
    if (times_.size() < window_) {
        times_.push_back(seconds);
    } else {
        times_[next_] = seconds;
        next_ = (next_ + 1) % window_;
    }
    if (times_.size() < window_) return;
    // Summed from scratch each time, the oldest first: a running sum would drift, and differ after a
    // resumption.
    double sum = 0;
    for (std::size_t i = 0; i < window_; ++i) sum += times_[(next_ + i) % window_];
    if (sum > 0) worst_ = std::max(worst_, static_cast<double>(window_) / sum);
}

std::vector<double> RateMeter::recent() const {
    std::vector<double> out(times_.begin() + static_cast<std::ptrdiff_t>(next_), times_.end());
    out.insert(out.end(), times_.begin(), times_.begin() + static_cast<std::ptrdiff_t>(next_));
    return out;
}

void RateMeter::restore(std::span<const double> recent, double worst) {
    const std::size_t kept = std::min(recent.size(), window_);
    times_.assign(recent.end() - static_cast<std::ptrdiff_t>(kept), recent.end());
    next_ = 0;
    worst_ = worst;
}

}  // namespace lamella
