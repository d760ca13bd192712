// Turns lines into moves and asks the motion model for their times.
#include "printers/serial/motion_timer.h"

#include <cmath>
#include <numbers>

#include "printers/serial/gcode_line.h"

namespace lamella {
namespace {

dvec2 turned_left(const dvec2& v) { return {-v.y, v.x}; }

}  // namespace

void MotionTimer::stand(double seconds) {
    seconds_.back() += static_cast<float>(seconds);
    if (!moves_.empty()) moves_.back().out = dvec2(0);
    stands_ = true;
}

void MotionTimer::move(const Position& to, double speed, double acceleration, const Arc* arc) {
    const dvec2 way{to.x - at_.x, to.y - at_.y};
    const double rise = to.z - at_.z, pushed = to.e - at_.e;
    at_ = to;
    MotionMove next;
    next.speed = speed;
    next.acceleration = acceleration;
    const double flat = std::hypot(way.x, way.y);
    if (arc != nullptr) {
        dvec2 centre{arc->i, arc->j};  // from the start
        if (arc->by_radius) {
            const double high = std::sqrt(std::max(0.0, arc->r * arc->r - flat * flat / 4));
            const double side = (arc->clockwise ? -1 : 1) * (arc->r < 0 ? -1 : 1);
            centre = way / 2.0;
            if (flat > 0) centre += turned_left(way) * (side * high / flat);
        }
        next.radius = std::hypot(centre.x, centre.y);
        const dvec2 from = -centre, end = way - centre;
        const double turn = arc->clockwise ? -1 : 1;
        double angle = turn * std::atan2(from.x * end.y - from.y * end.x, from.x * end.x + from.y * end.y);
        if (angle <= 1e-9) angle += 2 * std::numbers::pi;
        if (next.radius > 0) {
            next.length = std::hypot(angle * next.radius, rise);
            next.in = turned_left(from) * (turn / next.radius);
            next.out = turned_left(end) * (turn / std::max(1e-9, std::hypot(end.x, end.y)));
        }
    } else if (flat > 0) {
        next.length = std::hypot(flat, rise);
        next.in = next.out = way / flat;
    } else {
        next.length = rise != 0 ? std::abs(rise) : std::abs(pushed);
    }
    if (next.length <= 0 || !(speed > 0) || !(acceleration > 0)) return;
    if (stands_) next.in = dvec2(0);
    stands_ = false;
    moves_.push_back(next);
    line_of_move_.push_back(seconds_.size() - 1);
}

void MotionTimer::add(std::string_view command, const MachineState& after) {
    seconds_.push_back(0);
    const std::string name = command_word(command);
    const Position to{after.x(), after.y(), after.z(), after.e()};
    if (name == "G0" || name == "G1" || name == "G2" || name == "G3") {
        Arc arc;
        arc.clockwise = name == "G2";
        arc.i = command_value(command, 'I').value_or(0);
        arc.j = command_value(command, 'J').value_or(0);
        const auto radius = command_value(command, 'R');
        arc.by_radius = radius.has_value();
        arc.r = radius.value_or(0);
        const bool round = name == "G2" || name == "G3";
        const bool extrudes = to.e > at_.e;
        move(to, after.feed() / 60, extrudes ? limits_.acceleration : limits_.travel_acceleration,
             round ? &arc : nullptr);
        return;
    }
    if (name == "M204") {
        if (const auto both = command_value(command, 'S'))
            limits_.acceleration = limits_.travel_acceleration = *both;
        limits_.acceleration = command_value(command, 'P').value_or(limits_.acceleration);
        limits_.travel_acceleration = command_value(command, 'T').value_or(limits_.travel_acceleration);
    }
    at_ = to;  // homing and G92 move the origin, not the nozzle
    if (name == "G4") {
        stand(command_value(command, 'S').value_or(command_value(command, 'P').value_or(0) / 1000));
    } else if (name == "G28" || name == "G29" || name == "M400" || name == "M109" || name == "M190" ||
               name == "M0" || name == "M1" || name == "M600") {
        stand(0);
    }
}

void MotionTimer::add(std::string_view command, const GrblModes& after) {
    seconds_.push_back(0);
    if (command.starts_with('$')) return stand(0);
    const std::string name = command_word(command);
    if (name == "G4") return stand(command_value(command, 'P').value_or(0));
    if (name == "M0" || name == "M2" || name == "M30") return stand(0);
    const Position to{after.x(), after.y(), 0, 0};
    const double unit = after.inches() ? 25.4 : 1;
    Arc arc;
    arc.clockwise = after.motion() == 2;
    arc.i = unit * command_value(command, 'I').value_or(0);
    arc.j = unit * command_value(command, 'J').value_or(0);
    const auto radius = command_value(command, 'R');
    arc.by_radius = radius.has_value();
    arc.r = unit * radius.value_or(0);
    const bool round = after.motion() >= 2 && (to.x != at_.x || to.y != at_.y || arc.i != 0 || arc.j != 0);
    const double speed = after.motion() == 0 ? limits_.rapid_speed : after.feed() / 60;
    move(to, speed, limits_.acceleration, round ? &arc : nullptr);
}

std::vector<float> MotionTimer::take() {
    if (!moves_.empty()) {
        const std::vector<double> times = move_times(moves_, limits_.junction_deviation);
        for (std::size_t i = 0; i < times.size(); ++i)
            seconds_[line_of_move_[i]] += static_cast<float>(times[i]);
    }
    moves_.clear();
    line_of_move_.clear();
    stands_ = true;
    std::vector<float> lines;
    lines.swap(seconds_);
    return lines;
}

}  // namespace lamella
