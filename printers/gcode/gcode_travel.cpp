// Travel moves, with the retraction, wipe and lift around them.
#include "printers/gcode/gcode_travel.h"

#include <algorithm>
#include <utility>

namespace lamella {
namespace {

constexpr double shortest_search = 2;  // in line widths; shorter travels within an island are straight

}  // namespace

double travel_height(const PrinterProfile& profile, double z, double length) {
    if (profile.filament.retraction <= 0 || length < profile.gcode.z_hop_from) return z;
    return std::max(z, std::min(z + profile.gcode.z_hop, profile.filament.bed_z));
}

void leave_beads(GcodeMoves& moves, std::span<const dvec2> trail, double z, dvec2 to) {
    if (moves.retracts()) moves.retract(trail);
    moves.lift(z);
    moves.travel(to);
}

void reach_beads(GcodeMoves& moves, double top) {
    moves.lift(top);
    if (moves.retracts()) moves.restore();
}

void BeadTravel::go(dvec2 to, int from_island, int to_island, std::span<const dvec2> trail) {
    if (to == moves_.position()) return;  // the pieces of one bead follow each other
    const GcodeProfile& g = profile_.gcode;
    const bool same = from_island == to_island;
    std::optional<std::vector<dvec2>> corners;
    const bool step = glm::distance(moves_.position(), to) <= shortest_search * profile_.filament.line_width;
    if (same && g.travel_inside) corners = step ? std::vector<dvec2>() : corners_inside(to, to_island);
    const bool inside = g.travel_inside ? corners.has_value() : same;
    const double longest = inside ? g.retract_inside_from : g.retract_from;
    const bool retracted =
        moves_.retracts() && length_to(corners.value_or(std::vector<dvec2>()), to) > longest;
    const double z = moves_.z();
    if (retracted) {
        moves_.retract(trail);
        if (corners) corners = corners_inside(to, to_island);  // from the point where the wipe has ended
    }
    const std::vector<dvec2> between = corners.value_or(std::vector<dvec2>());
    if (retracted) moves_.lift(travel_height(profile_, z, length_to(between, to)));
    for (const dvec2 corner : between) moves_.travel(corner);
    moves_.travel(to);
    if (!retracted) return;
    moves_.lift(z);
    moves_.restore();
}

std::optional<std::vector<dvec2>> BeadTravel::corners_inside(dvec2 to, int island) {
    const auto i = static_cast<std::size_t>(island);
    if (island < 0 || i >= outlines_.size() || outlines_[i].empty()) return std::nullopt;
    if (island != island_) inner_.emplace(outlines_[i], profile_.filament.line_width);
    island_ = island;
    auto corners = inner_->way(moves_.position() - shift_, to - shift_);
    if (corners) {
        for (dvec2& corner : *corners) corner += shift_;
    }
    return corners;
}

double BeadTravel::length_to(std::span<const dvec2> corners, dvec2 to) const {
    double length = 0;
    dvec2 at = moves_.position();
    for (const dvec2 corner : corners) length += glm::distance(std::exchange(at, corner), corner);
    return length + glm::distance(at, to);
}

}  // namespace lamella
