// Motion model: durations of moves with trapezoidal speed profiles between corners.
#pragma once

#include <span>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// A straight move or an arc. Lengths in mm, speeds in mm/s, accelerations in mm/s^2.
struct MotionMove {
    double length = 0;
    double speed = 0;         ///< requested speed
    double acceleration = 0;  ///< along the path, and across it in arcs
    /// Unit directions at the start and end of the move. Zero if the move starts or ends at standstill, as
    /// moves of the extruder or of z alone do.
    dvec2 in{0}, out{0};
    double radius = 0;  ///< radius of an arc; 0: straight
};

/// Returns the duration of each move, s; the sequence starts and ends at standstill. The speed at a corner is
/// limited by the junction deviation (mm; S. K. Jeon 2011, grbl; Marlin planner.cpp), and by the speed along
/// an arc tangent to both moves (Klipper, toolhead.py), so that polylines are no faster than the curves that
/// they approximate. The planner is assumed to look ahead far enough.
std::vector<double> move_times(std::span<const MotionMove> moves, double junction_deviation);

/// Returns the highest speed at the corner between two moves, mm/s.
double corner_speed(const MotionMove& before, const MotionMove& after, double junction_deviation);

/// Measures the highest rate of moves over windows of `window` consecutive moves, moves per second. Durations
/// are added one by one.
class RateMeter {
  public:
    explicit RateMeter(int window) : window_(static_cast<std::size_t>(window)) {}
    void add(double seconds);
    double worst() const { return worst_; }

    /// Returns the last durations, the oldest first: the state with which another meter can continue.
    std::vector<double> recent() const;
    void restore(std::span<const double> recent, double worst);

  private:
    std::size_t window_;
    std::vector<double> times_;  ///< a ring buffer once it is full
    std::size_t next_ = 0;
    double worst_ = 0;
};

}  // namespace lamella
