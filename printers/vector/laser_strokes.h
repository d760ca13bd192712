// Stroke colours and widths by which laser software distinguishes cuts from engravings.
#pragma once

#include <array>

#include "printers/common/profile.h"
#include "printers/vector/sheet.h"

namespace lamella {

struct LaserStroke {
    const char* colour;  ///< "#rrggbb"
    double width;        ///< mm
};

/// Returns the strokes, indexed by CutPurpose. Drivers that work like printers take thin lines for cuts and
/// wide ones for engravings (Universal: 0.2 mm and more; Epilog: cuts 0.001 inch); other software uses the
/// colour alone.
const std::array<LaserStroke, cut_purposes>& laser_strokes(Laser laser);

}  // namespace lamella
