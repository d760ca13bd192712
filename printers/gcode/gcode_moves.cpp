// Turns beads into moves, and slows moves down for cooling or for the rate of lines.
#include "printers/gcode/gcode_moves.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "printers/gcode/gcode_roles.h"
#include "printers/gcode/gcode_travel.h"

namespace lamella {
namespace {

using Kind = GcodeMove::Kind;

constexpr double lift_speed = 10;         // mm/s; lead screws are slow
constexpr double shortest_piece = 0.002;  // mm; shorter pieces would vanish when coordinates are rounded
constexpr double word_unit = 0.001;       // mm; last decimal of X, Y, I and J
constexpr double filament_unit = 1e-5;    // mm; last decimal of E

/// The bead's points on the bed, without those too close to the one before, and its width at each, mm.
struct BeadPath {
    std::vector<dvec2> points;
    std::vector<double> widths;
};

BeadPath path_of(const Bead& bead, dvec2 shift) {
    BeadPath path{{bead.points.front() + shift}, {bead.width_at(0)}};
    const std::size_t n = bead.points.size();
    for (std::size_t i = 1; i < n + (bead.closed ? 1 : 0); ++i) {
        const dvec2 p = bead.points[i % n] + shift, way = p - path.points.back();
        if (way.x * way.x + way.y * way.y < shortest_piece * shortest_piece) continue;
        path.points.push_back(p);
        path.widths.push_back(bead.width_at(i % n));
    }
    return path;
}

/// Returns the first stretch of a path, up to `left` mm long.
std::vector<dvec2> stretch_of(std::span<const dvec2> path, double left) {
    std::vector<dvec2> points;
    for (const dvec2 p : path) {
        if (!points.empty()) {
            const dvec2 way = p - points.back();
            const double step = length(way);
            if (step >= left) {
                if (left >= shortest_piece) points.push_back(points.back() + way * (left / step));
                break;
            }
            left -= step;
        }
        points.push_back(p);
    }
    return points;
}

std::vector<PathPiece> pieces_of(const std::vector<dvec2>& points, const PrinterProfile& profile) {
    const double tolerance = profile.filament.tolerance;
    const bool merge = profile.gcode.lines_per_second > 0;
    if (profile.gcode.arcs) return arc_pieces(points, tolerance, merge, word_unit);
    return merge ? merged_pieces(points, tolerance) : straight_pieces(points);
}

MotionMove motion_of(const GcodeMove& move, dvec2 from) {
    MotionMove m{move.length, move.speed, move.acceleration};
    const bool in_plane = move.kind == Kind::travel || move.kind == Kind::extrude || move.kind == Kind::wipe;
    const double chord = length(move.to - from);
    if (!in_plane || chord == 0) return m;
    if (move.turn == 0) {
        m.in = m.out = (move.to - from) / chord;
        return m;
    }
    const auto tangent = [&](dvec2 at) {
        const dvec2 arm = at - move.center;
        return dvec2(-arm.y, arm.x) * (move.turn / length(arm));
    };
    m.in = tangent(from);
    m.out = tangent(move.to);
    m.radius = length(from - move.center);
    return m;
}

double total_of(const std::vector<double>& seconds) {
    double sum = 0;
    for (const double s : seconds) sum += s;
    return sum;
}

/// Lowers a speed to a value that an F word without decimals can express.
void slow(GcodeMove& move, double speed) {
    if (speed >= move.speed) return;
    move.speed = std::max(1.0, std::floor(speed * 60)) / 60;
    move.slowed = true;
}

}  // namespace

void GcodeMoves::add_extruder_move(Kind kind, double length) {
    const FilamentProfile& f = profile_.filament;
    GcodeMove move{kind};
    move.to = position_;
    move.length = length;
    move.speed = f.retraction_speed;
    move.acceleration = profile_.gcode.acceleration;
    moves_.push_back(move);
}

void GcodeMoves::retract(std::span<const dvec2> trail) {
    const FilamentProfile& f = profile_.filament;
    if (trail.size() < 2) return add_extruder_move(Kind::retract, f.retraction);
    const bool merge = profile_.gcode.lines_per_second > 0;
    const std::vector<PathPiece> pieces = merge ? merged_pieces(trail, f.tolerance) : straight_pieces(trail);
    double length = 0;
    for (const PathPiece& piece : pieces) length += piece.length;
    // All lengths are multiples of the unit of E, so that they add up to the length that is restored later.
    const auto in_words = [](double v) { return std::floor(v / filament_unit) * filament_unit; };
    const double along = in_words(std::min(f.retraction, length / f.travel_speed * f.retraction_speed));
    if (f.retraction > along) add_extruder_move(Kind::retract, f.retraction - along);
    // Firmware treats a wipe as a printing move.
    const double acceleration = moves_.empty() ? profile_.gcode.acceleration : moves_.back().acceleration;
    double gone = 0, drawn = 0;
    for (const PathPiece& piece : pieces) {
        gone += piece.length;
        GcodeMove move{Kind::wipe};
        move.to = piece.to;
        move.length = piece.length;
        move.filament = in_words(along * std::min(1.0, gone / length)) - drawn;
        move.speed = f.travel_speed;
        move.acceleration = acceleration;
        drawn += move.filament;
        moves_.push_back(move);
    }
    moves_.back().filament += along - drawn;
    position_ = trail.back();
}

void GcodeMoves::restore() { add_extruder_move(Kind::restore, profile_.filament.retraction); }

void GcodeMoves::travel(dvec2 to) {
    const double distance = length(to - position_);
    if (distance < word_unit / 2) return;
    GcodeMove move{Kind::travel};
    move.to = to;
    move.length = distance;
    move.speed = profile_.filament.travel_speed;
    move.acceleration = travel_acceleration(profile_.gcode);
    moves_.push_back(move);
    position_ = to;
}

void GcodeMoves::lift(double z) {
    if (z == z_) return;
    GcodeMove move{Kind::lift};
    move.to = position_;
    move.z = z;
    move.length = std::abs(z - z_);
    move.speed = lift_speed;
    move.acceleration = travel_acceleration(profile_.gcode);
    moves_.push_back(move);
    z_ = z;
}

void GcodeMoves::extrude(const PathPiece& piece, double area, double speed, double acceleration, int bead) {
    const double section = pi / 4 * profile_.filament.filament * profile_.filament.filament;
    GcodeMove move{Kind::extrude};
    move.turn = piece.turn;
    move.bead = bead;
    move.to = piece.to;
    move.center = piece.center;
    move.length = piece.length;
    move.filament = piece.run * area / section;
    move.speed = speed;
    move.acceleration = acceleration;
    moves_.push_back(move);
    position_ = piece.to;
}

std::vector<dvec2> add_beads(const Toolpaths& paths, const PrinterProfile& profile, double height,
                             bool first_layer, dvec2 shift, GcodeMoves& moves, const CancelToken* cancel) {
    BeadTravel travel(profile, paths.outlines, shift, moves);
    std::vector<dvec2> trail;  // from the end of the last bead: along a loop again, back along an open line
    for (std::size_t i = 0; i < paths.beads.size(); ++i) {
        stop_if_cancelled(cancel);
        const Bead& bead = paths.beads[i];
        BeadPath path = path_of(bead, shift);
        if (i > 0) travel.go(path.points.front(), paths.beads[i - 1].island, bead.island, trail);
        const double speed = role_speed(profile, bead, first_layer);
        const double acceleration = role_acceleration(profile.gcode, bead, first_layer);
        const double flow = bead.flow * (bead.hangs ? profile.gcode.bridge_flow : 1);
        const auto area = [&](double width) { return flow * bead_area(width, height); };
        // The points of a bead of varying width are already reduced.
        const std::vector<PathPiece> pieces =
            bead.widths.empty() ? pieces_of(path.points, profile) : straight_pieces(path.points);
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            const double section = bead.widths.empty()
                                       ? area(bead.width)
                                       : (area(path.widths[k]) + area(path.widths[k + 1])) / 2;
            moves.extrude(pieces[k], section, speed, acceleration, static_cast<int>(i));
            moves.moves().back().width = bead_width(section, height);
        }
        if (!bead.closed) std::ranges::reverse(path.points);
        trail = stretch_of(path.points, profile.gcode.wipe);
    }
    return trail;
}

std::vector<double> seconds_of(std::span<const GcodeMove> moves, dvec2 position,
                               const GcodeProfile& profile) {
    std::vector<MotionMove> motion;
    motion.reserve(moves.size());
    for (const GcodeMove& move : moves) {
        motion.push_back(motion_of(move, position));
        position = move.to;
    }
    return move_times(motion, profile.junction_deviation);
}

void slow_to_time(std::vector<GcodeMove>& moves, dvec2 position, const GcodeProfile& profile, double least) {
    if (least <= 0 || moves.empty()) return;
    if (total_of(seconds_of(moves, position, profile)) >= least) return;
    const std::vector<GcodeMove> fast = moves;
    double fastest = 0;
    for (const GcodeMove& move : fast) {
        if (move.kind == Kind::extrude) fastest = std::max(fastest, move.speed);
    }
    const auto apply = [&](double factor) {
        moves = fast;
        for (GcodeMove& move : moves) {
            if (move.kind != Kind::extrude) continue;
            slow(move, std::max(move.speed * factor, std::min(profile.min_speed, move.speed)));
        }
        return total_of(seconds_of(moves, position, profile));
    };
    double too_fast = 1, slow_enough = std::min(1.0, profile.min_speed / std::max(fastest, 1e-9));
    if (apply(slow_enough) < least) return;
    constexpr int halvings = 20;  // until the speed is accurate to a millionth
    for (int i = 0; i < halvings; ++i) {
        const double middle = (too_fast + slow_enough) / 2;
        (apply(middle) < least ? too_fast : slow_enough) = middle;
    }
    apply(slow_enough);
}

double slow_to_rate(std::vector<GcodeMove>& moves, const GcodeProfile& profile) {
    if (profile.lines_per_second <= 0) return 0;
    const auto window = static_cast<std::ptrdiff_t>(profile.planner_blocks);
    const auto count = static_cast<std::ptrdiff_t>(moves.size());
    std::vector<double> before(moves.size() + 1, 0);  // time at the requested speeds, s
    const auto at = [](std::ptrdiff_t i) { return static_cast<std::size_t>(i); };
    for (std::ptrdiff_t i = 0; i < count; ++i)
        before[at(i) + 1] = before[at(i)] + moves[at(i)].length / moves[at(i)].speed;
    // Slow-down factor of each window. A move gets the largest factor of all windows that contain it.
    std::vector<double> factors(moves.size(), 1);
    for (std::ptrdiff_t end = 1; end < count + window; ++end) {
        const std::ptrdiff_t first = std::max<std::ptrdiff_t>(0, end - window), last = std::min(end, count);
        const double seconds = before[at(last)] - before[at(first)];
        const double least = static_cast<double>(last - first) / profile.lines_per_second;
        if (!(seconds < least)) continue;
        const double factor = least / std::max(seconds, 1e-9);
        for (std::ptrdiff_t i = first; i < last; ++i) factors[at(i)] = std::max(factors[at(i)], factor);
    }
    double slowed = 0;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        GcodeMove& move = moves[at(i)];
        if (factors[at(i)] <= 1) continue;
        slow(move, move.speed / factors[at(i)]);
        if (move.kind == Kind::extrude) slowed += move.length;
    }
    return slowed;
}

}  // namespace lamella
