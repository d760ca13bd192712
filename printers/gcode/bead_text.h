// BeadText: the lines that lay a tool's beads, and what they take.
#pragma once

#include <string>
#include <vector>

#include "engine/base/archive.h"
#include "printers/gcode/gcode_moves.h"
#include "printers/gcode/layer_beads.h"
#include "printers/gcode/object_labels.h"

namespace lamella {

/// Lines from the first bead on. Lengths in mm.
struct BeadText {
    void serialize(Archive& parcel) {
        parcel(tool, when, text, first, last, trail, filament, support_filament, slowed, seconds);
    }

    int tool = 0;
    LaidWhen when = LaidWhen::always;
    std::string text;
    dvec2 first{0};  ///< start of the first bead on the bed
    dvec2 last{0};
    std::vector<dvec2> trail;     ///< path from the end of the last bead along which the nozzle may be wiped
    double filament = 0;          ///< extruded
    double support_filament = 0;  ///< share of supports in `filament`
    double slowed = 0;            ///< length of extrusion slowed down for the rate of lines
    std::vector<double> seconds;  ///< duration of each move
};

/// How a layer's beads become lines.
struct BeadTextSettings {
    const PrinterProfile& profile;
    const ObjectLabels& labels;
    dvec2 shift{0};  ///< from part to bed coordinates, mm
    double fan = 0;  ///< share of full speed
};

/// Returns the lines of each tool's beads, without those that have none. They are slowed down so that those
/// that are always laid take the layer's least time together.
std::vector<BeadText> bead_texts(const LayerPaths& paths, const Layer& layer,
                                 const BeadTextSettings& settings);

}  // namespace lamella
