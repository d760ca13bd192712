// Beads to moves, moves slowed down, moves to text.
#include "printers/gcode/bead_text.h"

#include "printers/gcode/gcode_text.h"

namespace lamella {

namespace {

struct LaidMoves {
    const ToolBeads* beads = nullptr;
    BeadText text;
    std::vector<GcodeMove> moves;
    double fast = 0;  ///< time before they are slowed down, s, where there is a least time
};

double total(const std::vector<double>& seconds) {
    double sum = 0;
    for (const double s : seconds) sum += s;
    return sum;
}

LaidMoves laid(const ToolBeads& beads, const Layer& layer, const BeadTextSettings& settings) {
    LaidMoves made;
    made.beads = &beads;
    BeadText& text = made.text;
    text.tool = beads.tool;
    text.when = beads.when;
    text.first = beads.paths.beads.front().points.front() + settings.shift;
    GcodeMoves planned(settings.profile, text.first, layer.top());
    text.trail = add_beads(beads.paths, settings.profile, layer.thickness(), layer.level() == 0,
                           settings.shift, planned, layer.cancel());
    text.last = planned.position();
    made.moves = std::move(planned.moves());
    if (settings.profile.gcode.min_layer_time > 0)
        made.fast = total(seconds_of(made.moves, text.first, settings.profile.gcode));
    return made;
}

void write(LaidMoves& made, const BeadTextSettings& settings) {
    const std::vector<Bead>& beads = made.beads->paths.beads;
    BeadText& text = made.text;
    text.slowed = slow_to_rate(made.moves, settings.profile.gcode);
    text.seconds = seconds_of(made.moves, text.first, settings.profile.gcode);
    GcodeText lines(settings.profile, &settings.labels);
    lines.fan(settings.fan, settings.profile.gcode.bridge_fan);
    lines.moves(made.moves, text.first, beads);
    text.text = lines.text();
    text.filament = lines.filament();
    for (const GcodeMove& move : made.moves) {
        if (move.bead >= 0 && beads[static_cast<std::size_t>(move.bead)].role == Role::support)
            text.support_filament += move.filament;
    }
}

}  // namespace

std::vector<BeadText> bead_texts(const LayerPaths& paths, const Layer& layer,
                                 const BeadTextSettings& settings) {
    std::vector<LaidMoves> all;
    double fast = 0;
    for (const ToolBeads& beads : paths.beads) {
        if (beads.paths.beads.empty()) continue;
        all.push_back(laid(beads, layer, settings));
        if (beads.when == LaidWhen::always) fast += all.back().fast;
    }
    const double least = settings.profile.gcode.min_layer_time;
    std::vector<BeadText> texts;
    texts.reserve(all.size());
    for (LaidMoves& made : all) {
        if (made.text.when == LaidWhen::always && made.fast > 0)
            slow_to_time(made.moves, made.text.first, settings.profile.gcode, least * (made.fast / fast));
        write(made, settings);
        texts.push_back(std::move(made.text));
    }
    return texts;
}

}  // namespace lamella
