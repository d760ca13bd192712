// Beads of pieces without room for walls and infill.
#pragma once

#include "printers/polygons/polygons.h"
#include "printers/toolpath/bead.h"
#include "printers/toolpath/thin_parts.h"

namespace lamella {

/// Returns beads along the lines of thin parts with the volume of `area` mm^2. They are widened or narrowed
/// for that, and get extra flow as far as their round ends have room.
std::vector<Bead> tapered_beads(const ThinParts& parts, double area, const LineSettings& line, Role role);

/// Returns single beads along the centre lines of a region of uniform thickness, mm (see center_lines); empty
/// if the region is not a network of such walls.
std::vector<Bead> center_line_beads(const Polygons& region, double thickness, double area,
                                    const LineSettings& line, Role role);

/// Returns loops `inset` mm inside a piece with the volume of `area` mm^2, as far as they do not bulge.
std::vector<Bead> loop_beads(const Polygons& piece, double inset, double area, const LineSettings& line,
                             Role role);

/// Returns one short bead along the longest chord of a small region, with the volume of `area` mm^2.
std::vector<Bead> chord_bead(const Polygons& region, double area, const LineSettings& line);

}  // namespace lamella
