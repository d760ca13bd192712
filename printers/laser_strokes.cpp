// One row a kind of software: engrave, score, inner cut, outer cut.
#include "printers/laser_strokes.h"

namespace lamella {
namespace {

using Strokes = std::array<LaserStroke, cut_purposes>;

constexpr double hairline = 0.01;  // every driver's cut
constexpr double inch_thousandth = 0.0254;
constexpr double engraved = 0.3;  // every driver's engraving

// Red cuts and black engraves everywhere; blue for what is cut before the outline is the workshops' habit.
constexpr Strokes plain{
    {{"#000000", hairline}, {"#0000ff", hairline}, {"#ff0000", hairline}, {"#ff0000", hairline}}};
constexpr Strokes generic{
    {{"#000000", engraved}, {"#00ff00", hairline}, {"#0000ff", hairline}, {"#ff0000", hairline}}};
// LightBurn's palette begins with black, blue, red and a green; it goes by colour alone.
constexpr Strokes lightburn{
    {{"#000000", hairline}, {"#00e000", hairline}, {"#0000ff", hairline}, {"#ff0000", hairline}}};
// Glowforge makes a step of every colour. These rise as numbers, in case it takes them in that order.
constexpr Strokes glowforge{
    {{"#000000", hairline}, {"#0000ff", hairline}, {"#00ff00", hairline}, {"#ff0000", hairline}}};
constexpr Strokes epilog{{{"#000000", engraved},
                          {"#00ff00", inch_thousandth},
                          {"#0000ff", inch_thousandth},
                          {"#ff0000", inch_thousandth}}};
constexpr Strokes xtool{
    {{"#000000", hairline}, {"#00ff00", hairline}, {"#0000ff", hairline}, {"#ff0000", hairline}}};

}  // namespace

const Strokes& laser_strokes(Laser laser) {
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
