// Moves to text, with their time and filament.
#include "printers/gcode/bead_text.h"

#include "printers/gcode/gcode_text.h"
#include "printers/gcode/laid_beads.h"

namespace lamella {

namespace {

BeadText text_of(LaidBeads& made, const BeadTextSettings& settings) {
    const std::vector<Bead>& beads = made.beads->paths.beads;
    BeadText text;
    text.tool = made.beads->tool;
    text.when = made.beads->when;
    text.first = made.first;
    text.last = made.last;
    text.trail = std::move(made.trail);
    text.slowed = made.slowed;
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
    return text;
}

}  // namespace

std::vector<BeadText> bead_texts(const LayerPaths& paths, const Layer& layer,
                                 const BeadTextSettings& settings) {
    std::vector<BeadText> texts;
    for (LaidBeads& made : lay_beads(paths, layer, settings.profile, settings.shift))
        texts.push_back(text_of(made, settings));
    return texts;
}

}  // namespace lamella
