// Plans a layer's moves as the back-end does, and describes them.
#include "app/jobs/layer_paths.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/http/http_server.h"
#include "printers/gcode/gcode_roles.h"
#include "printers/gcode/gcode_travel.h"
#include "printers/gcode/laid_beads.h"
#include "printers/registry.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;
using Kind = GcodeMove::Kind;

/// A number as the reply has it: to a tenth of a micrometre.
double brief(double value) { return std::round(value * 1e4) / 1e4; }

/// The speed that the file's F word states, whole mm a minute, in mm/s.
double stated_speed(double speed) { return std::round(speed * 60) / 60; }

/// Returns points along an arc, without its start, whose chords are within a tolerance.
std::vector<dvec2> arc_points(dvec2 from, const GcodeMove& move, double tolerance) {
    constexpr double pi = 3.14159265358979323846;
    const dvec2 arm = from - move.center, end = move.to - move.center;
    const double radius = length(arm);
    double angle = std::atan2(arm.x * end.y - arm.y * end.x, arm.x * end.x + arm.y * end.y);
    if (angle * move.turn <= 0) angle += 2 * pi * move.turn;
    const double step = 2 * std::acos(std::max(0.0, 1 - tolerance / std::max(radius, tolerance)));
    const int count = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / step)));
    std::vector<dvec2> points;
    for (int i = 1; i < count; ++i) {
        const double turned = angle * i / count, c = std::cos(turned), s = std::sin(turned);
        points.push_back(move.center + dvec2(arm.x * c - arm.y * s, arm.x * s + arm.y * c));
    }
    points.push_back(move.to);
    return points;
}

/// Moves that follow each other, in the coordinates of the job.
struct Line {
    std::vector<dvec2> points;
    std::vector<double> widths, speeds;  ///< of each segment

    void add(dvec2 to, const GcodeMove& move) {
        points.push_back(to);
        widths.push_back(move.width);
        speeds.push_back(stated_speed(move.speed));
    }
};

/// Adds the greatest of some values, and all of them where they vary.
void put(Json& json, const char* one, const char* all, const std::vector<double>& values) {
    const auto [least, greatest] = std::ranges::minmax(values);
    json[one] = brief(greatest);
    if (brief(least) == brief(greatest)) return;
    Json list = Json::array();
    for (const double value : values) list.push_back(brief(value));
    json[all] = std::move(list);
}

Json flat(const std::vector<dvec2>& points) {
    Json list = Json::array();
    for (const dvec2 p : points) {
        list.push_back(brief(p.x));
        list.push_back(brief(p.y));
    }
    return list;
}

/// Describes the moves of a layer one after the other.
class Description {
  public:
    Description(const PrinterProfile& profile, dvec2 shift) : profile_(profile), shift_(shift) {}

    void begin_at(dvec2 position) { position_ = position; }

    void add(const std::vector<GcodeMove>& moves, const std::vector<Bead>& beads, int tool) {
        for (const double s : seconds_of(moves, position_, profile_.gcode)) seconds_ += s;
        for (std::size_t i = 0; i < moves.size();) {
            std::size_t end = i + 1;
            while (end < moves.size() && moves[end].bead == moves[i].bead) ++end;
            const std::span<const GcodeMove> same(&moves[i], end - i);
            if (moves[i].bead < 0)
                add_travel(same);
            else
                add_path(same, beads[static_cast<std::size_t>(moves[i].bead)], tool);
            i = end;
        }
    }

    Json json(double z) {
        return {{"paths", std::move(paths_)},
                {"travels", std::move(travels_)},
                {"seconds", brief(seconds_)},
                {"z", z}};
    }

  private:
    /// Returns the line of some moves from the nozzle on, and moves the nozzle.
    Line line_of(std::span<const GcodeMove> moves) {
        Line line{{position_ - shift_}, {}, {}};
        for (const GcodeMove& move : moves) {
            if (move.kind == Kind::lift || move.kind == Kind::retract || move.kind == Kind::restore) continue;
            if (move.turn == 0) {
                line.add(move.to - shift_, move);
            } else {
                for (const dvec2 p : arc_points(position_, move, profile_.filament.tolerance / 2))
                    line.add(p - shift_, move);
            }
            position_ = move.to;
        }
        return line;
    }

    void add_path(std::span<const GcodeMove> moves, const Bead& bead, int tool) {
        Line line = line_of(moves);
        // A closed bead may end a little before its start, where the last piece is too short to be written.
        const bool closed =
            bead.closed && line.points.size() > 3 && line.points.back() == line.points.front();
        if (closed) line.points.pop_back();
        Json path{{"role", role_name(bead)}, {"tool", tool}};
        put(path, "width", "widths", line.widths);
        put(path, "speed", "speeds", line.speeds);
        path["closed"] = closed;
        path["points"] = flat(line.points);
        paths_.push_back(std::move(path));
    }

    void add_travel(std::span<const GcodeMove> moves) {
        const Line line = line_of(moves);
        if (line.speeds.empty()) return;
        Json travel{{"after", paths_.size()}};
        put(travel, "speed", "speeds", line.speeds);
        travel["retracts"] = std::ranges::any_of(
            moves, [](const GcodeMove& m) { return m.kind == Kind::retract || m.kind == Kind::wipe; });
        travel["points"] = flat(line.points);
        travels_.push_back(std::move(travel));
    }

    const PrinterProfile& profile_;
    dvec2 shift_;
    dvec2 position_{0};  // of the nozzle on the bed
    double seconds_ = 0;
    Json paths_ = Json::array(), travels_ = Json::array();
};

/// Returns the way from the end of some beads to the first of the next.
std::vector<GcodeMove> way_between(const LaidBeads& from, dvec2 to, double top,
                                   const PrinterProfile& profile) {
    GcodeMoves moves(profile, from.last, top);
    leave_beads(moves, from.trail, travel_height(profile, top, glm::distance(from.last, to)), to);
    reach_beads(moves, top);
    slow_to_rate(moves.moves(), profile.gcode);
    return std::move(moves.moves());
}

}  // namespace

bool lays_beads(const PrinterProfile& printer) {
    return makes_beads(printer) && printer.gcode.flavour != Flavour::grbl;
}

Json layer_paths(const ServedJob& job, int layer, const CancelToken* cancel) {
    const PrinterProfile& printer = job.recipe.printer;
    if (!lays_beads(printer))
        throw HttpError(400, printer.name + " lays no beads; accepted: machines for filament");
    const Layer cut(job.job(), layer, cancel);
    const LayerPaths planned = LayerBeads(job.job(), printer).plan(cut, ObjectLabels());
    const dvec2 shift = bed_shift(job.job(), printer);
    const std::vector<LaidBeads> all = lay_beads(planned, cut, printer, shift);
    Description description(printer, shift);
    LaidChoice laid;
    int in_use = ToolBeads::any;
    const LaidBeads* before = nullptr;
    for (const LaidBeads& next : all) {
        stop_if_cancelled(cancel);
        const int tool = next.beads->tool;
        if (in_use == ToolBeads::any) in_use = tool;
        if (!laid.takes(tool, next.beads->when, in_use)) continue;
        if (tool != ToolBeads::any) in_use = tool;
        if (before == nullptr)
            description.begin_at(next.first);
        else
            description.add(way_between(*before, next.first, cut.top(), printer), {}, 0);
        description.add(next.moves, next.beads->paths.beads, std::max(in_use, 0));
        before = &next;
    }
    return description.json(cut.z());
}

}  // namespace lamella
