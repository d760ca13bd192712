// Beads to moves, and moves slowed down.
#include "printers/gcode/laid_beads.h"

namespace lamella {

namespace {

double total(const std::vector<double>& seconds) {
    double sum = 0;
    for (const double s : seconds) sum += s;
    return sum;
}

LaidBeads laid(const ToolBeads& beads, const Layer& layer, const PrinterProfile& profile, dvec2 shift) {
    LaidBeads made;
    made.beads = &beads;
    made.first = beads.paths.beads.front().points.front() + shift;
    GcodeMoves planned(profile, made.first, layer.top());
    made.trail = add_beads(beads.paths, profile, layer.thickness(), layer.level() == 0, shift, planned,
                           layer.cancel());
    made.last = planned.position();
    made.moves = std::move(planned.moves());
    return made;
}

/// Slows beads that are always laid down, until they take `least` seconds together.
void slow_to_layer_time(std::vector<LaidBeads>& all, const GcodeProfile& profile, double least) {
    if (least <= 0) return;
    std::vector<double> fast;  // of each, before
    double together = 0;
    for (const LaidBeads& made : all) {
        fast.push_back(total(seconds_of(made.moves, made.first, profile)));
        if (made.beads->when == LaidWhen::always) together += fast.back();
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].beads->when == LaidWhen::always && fast[i] > 0)
            slow_to_time(all[i].moves, all[i].first, profile, least * (fast[i] / together));
    }
}

}  // namespace

dvec2 bed_shift(const Job& job, const PrinterProfile& profile) {
    const dvec3 center = job.bounds.center();
    return dvec2(profile.filament.bed_x, profile.filament.bed_y) * 0.5 - dvec2(center.x, center.y);
}

std::vector<LaidBeads> lay_beads(const LayerPaths& paths, const Layer& layer, const PrinterProfile& profile,
                                 dvec2 shift) {
    std::vector<LaidBeads> all;
    for (const ToolBeads& beads : paths.beads)
        if (!beads.paths.beads.empty()) all.push_back(laid(beads, layer, profile, shift));
    slow_to_layer_time(all, profile.gcode, profile.gcode.min_layer_time);
    for (LaidBeads& made : all) made.slowed = slow_to_rate(made.moves, profile.gcode);
    return all;
}

bool LaidChoice::takes(int tool, LaidWhen when, int in_use) {
    if (tool != tool_) is_changed_ = tool != ToolBeads::any && tool != in_use;
    tool_ = tool;
    return when == LaidWhen::always || is_changed_ == (when == LaidWhen::tool_changed);
}

}  // namespace lamella
