// Beads of pieces that have no room for walls and infill.
#pragma once

#include "printers/polygons/polygons.h"
#include "printers/toolpath/bead.h"
#include "printers/toolpath/thin_parts.h"

namespace lamella {

/// Beads along the lines of thin parts, with the volume of `area` mm^2. They become wider or narrower for
/// that, and take more plastic than their length asks for where their round ends have room for it.
std::vector<Bead> tapered_beads(const ThinParts& parts, double area, const LineSettings& line, Role role);

/// Single beads along the middle of a region of even thickness (see center_lines), mm; none when it is not
/// one for that.
std::vector<Bead> center_line_beads(const Polygons& region, double thickness, double area,
                                    const LineSettings& line, Role role);

/// Loops `inset` mm inside a piece that lay down the volume of `area` mm^2, as far as they do not bulge.
std::vector<Bead> loop_beads(const Polygons& piece, double inset, double area, const LineSettings& line,
                             Role role);

/// One short bead along the longest chord of a small region, of `area` mm^2.
std::vector<Bead> chord_bead(const Polygons& region, double area, const LineSettings& line);

}  // namespace lamella
