// Formats words and lines of G-code.
#include "printers/gcode/gcode_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/number_format.h"
#include "printers/gcode/gcode_flavour.h"
#include "printers/gcode/gcode_roles.h"

namespace lamella {
namespace {

using Kind = GcodeMove::Kind;

/// Returns the part of the plate that each move belongs to. Moves between beads of one part are its own,
/// those on the way to another belong to none.
std::vector<int> objects_of(std::span<const GcodeMove> moves, std::span<const Bead> beads) {
    std::vector<int> before(moves.size(), -1);
    int last = -1;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        if (moves[i].bead >= 0) last = beads[static_cast<std::size_t>(moves[i].bead)].object;
        before[i] = last;
    }
    int next = -1;
    for (std::size_t i = moves.size(); i-- > 0;) {
        if (moves[i].bead >= 0) next = before[i];
        if (before[i] != next) before[i] = -1;
    }
    return before;
}

double on_grid(double coordinate) { return std::round(coordinate * 1000) / 1000; }

}  // namespace

std::string comment_text(const std::string& text) {
    constexpr std::size_t most = 64;
    std::string clean;
    for (const char c : text.substr(0, most)) clean += ' ' <= c && c <= '~' ? c : '?';
    return clean;
}

std::string duration_text(double seconds) {
    const auto s = static_cast<std::int64_t>(std::min(seconds, 1e12));
    if (s >= 86400) return fmt::format("{}d {}h {}m {}s", s / 86400, s / 3600 % 24, s / 60 % 60, s % 60);
    if (s >= 3600) return fmt::format("{}h {}m {}s", s / 3600, s / 60 % 60, s % 60);
    return fmt::format("{}m {}s", s / 60, s % 60);
}

void GcodeText::word(char letter, double value, int decimals) {
    text_ += ' ';
    text_ += letter;
    append_number(text_, value, decimals);
}

void GcodeText::speed(double mm_per_second) {
    if (mm_per_second == speed_) return;
    speed_ = mm_per_second;
    word('F', mm_per_second * 60, 0);
}

void GcodeText::announce(const Bead& bead, double bead_width) {
    if (bead.hangs != hangs_ && bridge_fan_ != fan_)
        line(fan_line(profile_.gcode.flavour, bead.hangs ? bridge_fan_ : fan_));
    hangs_ = bead.hangs;
    const std::string role = role_name(bead);
    if (role != role_) line(";TYPE:" + role);
    const std::string width = format_number(bead_width, 3);
    if (width != width_) line(";WIDTH:" + width);
    role_ = role;
    width_ = width;
}

void GcodeText::acceleration(const GcodeMove& move) {
    if (!sets_acceleration(profile_.gcode)) return;
    const Flavour flavour = profile_.gcode.flavour;
    if (move.kind != Kind::extrude && (move.kind != Kind::travel || has_travel_acceleration(flavour))) return;
    if (move.acceleration == acceleration_) return;
    acceleration_ = move.acceleration;
    line(acceleration_line(flavour, move.acceleration));
}

void GcodeText::move(const GcodeMove& move, dvec2 from) {
    switch (move.kind) {
        case Kind::travel:
            text_ += "G0";
            word('X', move.to.x, 3);
            word('Y', move.to.y, 3);
            break;
        case Kind::lift:
            text_ += "G0";
            word('Z', move.z, 3);
            break;
        case Kind::retract:
        case Kind::restore:
            text_ += "G1";
            word('E', move.kind == Kind::restore ? move.length : -move.length, 5);
            break;
        case Kind::wipe:
            text_ += "G1";
            word('X', move.to.x, 3);
            word('Y', move.to.y, 3);
            word('E', -move.filament, 5);
            break;
        case Kind::extrude:
            text_ += move.turn == 0 ? "G1" : move.turn > 0 ? "G3" : "G2";
            word('X', move.to.x, 3);
            word('Y', move.to.y, 3);
            if (move.turn != 0) {
                word('I', move.center.x - on_grid(from.x), 3);
                word('J', move.center.y - on_grid(from.y), 3);
            }
            word('E', move.filament, 5);
            filament_ += move.filament;
            break;
    }
    speed(move.speed);
    text_ += '\n';
}

void GcodeText::moves(std::span<const GcodeMove> moves, dvec2 position, std::span<const Bead> beads) {
    const std::vector<int> objects =
        labels_ == nullptr ? std::vector<int>(moves.size(), -1) : objects_of(moves, beads);
    int object = -1;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        const GcodeMove& m = moves[i];
        if (objects[i] != object) lines(labels_->change(object, objects[i]));
        object = objects[i];
        if (m.bead >= 0) announce(beads[static_cast<std::size_t>(m.bead)], m.width);
        acceleration(m);
        move(m, position);
        position = m.to;
    }
    if (object >= 0) lines(labels_->change(object, -1));
}

}  // namespace lamella
