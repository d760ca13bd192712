// Stroke tables, one per laser software: engrave, score, inner cut, outer cut.
#include "printers/vector/laser_strokes.h"

namespace lamella {
namespace {

using LaserStrokes = std::array<LaserStroke, cut_purposes>;

constexpr double hairline_width = 0.01;  // every driver takes it for a cut
constexpr double inch_thousandth = 0.0254;
constexpr double engraved = 0.3;  // every driver takes it for an engraving

// All software takes red for cuts and black for engravings. Workshops usually use blue for cuts made before
// the outline.
constexpr LaserStrokes plain{{{"#000000", hairline_width},
                              {"#0000ff", hairline_width},
                              {"#ff0000", hairline_width},
                              {"#ff0000", hairline_width}}};
constexpr LaserStrokes generic{{{"#000000", engraved},
                                {"#00ff00", hairline_width},
                                {"#0000ff", hairline_width},
                                {"#ff0000", hairline_width}}};
// LightBurn uses the colour alone; its palette begins with black, blue, red and a green.
constexpr LaserStrokes lightburn{{{"#000000", hairline_width},
                                  {"#00e000", hairline_width},
                                  {"#0000ff", hairline_width},
                                  {"#ff0000", hairline_width}}};
// Glowforge makes a step for each colour. As numbers these colours ascend, in case it executes them in that
// order.
constexpr LaserStrokes glowforge{{{"#000000", hairline_width},
                                  {"#0000ff", hairline_width},
                                  {"#00ff00", hairline_width},
                                  {"#ff0000", hairline_width}}};
constexpr LaserStrokes epilog{{{"#000000", engraved},
                               {"#00ff00", inch_thousandth},
                               {"#0000ff", inch_thousandth},
                               {"#ff0000", inch_thousandth}}};
constexpr LaserStrokes xtool{{{"#000000", hairline_width},
                              {"#00ff00", hairline_width},
                              {"#0000ff", hairline_width},
                              {"#ff0000", hairline_width}}};

}  // namespace

const LaserStrokes& laser_strokes(Laser laser) {
    switch (laser) {
        case Laser::none:
            return plain;
        case Laser::generic:
        case Laser::trotec:
            return generic;
        case Laser::lightburn:
            return lightburn;
        case Laser::epilog:
            return epilog;
        case Laser::glowforge:
            return glowforge;
        case Laser::xtool:
            return xtool;
    }
    return plain;
}

}  // namespace lamella
