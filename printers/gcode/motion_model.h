// How long a machine takes for a row of moves: trapezoids of speed between corners.
#pragma once

#include <span>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// A straight move or an arc. Lengths in mm, speeds in mm/s, accelerations in mm/s^2.
struct MotionMove {
    double length = 0;
    double speed = 0;         ///< asked for
    double acceleration = 0;  ///< along the path, and across it in curves
    /// Unit directions in which the move begins and ends; zero where it begins or ends at a standstill, as
    /// moves of the extruder or of z alone do.
    dvec2 in{0}, out{0};
    double radius = 0;  ///< of an arc; 0: straight
};

/// The seconds that each move takes, from standstill to standstill. Corners are passed at the speed that
/// junction deviation (mm) allows (S. K. Jeon 2011, grbl; Marlin planner.cpp) and, so that polylines are no
/// faster than the curves that they stand for, at which an arc tangent to both moves would be followed
/// (Klipper, toolhead.py). The planner is taken to look ahead far enough.
std::vector<double> move_times(std::span<const MotionMove> moves, double junction_deviation);

/// The greatest speed at a corner between two moves, mm/s.
double corner_speed(const MotionMove& before, const MotionMove& after, double junction_deviation);

/// The highest rate of moves in windows of so many consecutive ones, moves a second. Takes times one by one.
class RateMeter {
  public:
    explicit RateMeter(int window) : window_(static_cast<std::size_t>(window)) {}
    void add(double seconds);
    double worst() const { return worst_; }

    /// The last times, the oldest first: what a meter that goes on from here has to know.
    std::vector<double> recent() const;
    void restore(std::span<const double> recent, double worst);

  private:
    std::size_t window_;
    std::vector<double> times_;  ///< a ring, once it is full
    std::size_t next_ = 0;
    double worst_ = 0;
};

}  // namespace lamella
