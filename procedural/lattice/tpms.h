// Triply periodic minimal surfaces: gyroid, Schwarz P, Schwarz D and Neovius, as a sheet or as a network.
#pragma once

#include "engine/field/field.h"
#include "engine/field/grading.h"

namespace lamella {

/// The surface g = 0 in its nodal approximation (von Schnering and Nesper, Z. Phys. B 83, 1991), with s and c
/// for the sine and cosine of the angles x, y, z:
enum class TpmsKind : unsigned char {
    gyroid,     ///< sx cy + sy cz + sz cx
    schwarz_p,  ///< cx + cy + cz
    schwarz_d,  ///< sx sy sz + sx cy cz + cx sy cz + cx cy sz
    neovius     ///< 3 (cx + cy + cz) + 4 cx cy cz
};

/// What a triply periodic solid is made of. The angles at a point p are (p - c) 2 pi / period(p), where c is
/// the region's centre.
///
/// A sheet is |g| < m (pi / period) thickness, where m is the largest gradient of g on the surface g = 0, in
/// angles. So the wall is nowhere thinner than asked, to first order, and is thicker where g is less steep.
///
/// A network is g < s + M (pi / period) thickness, where s is the least level at which the solid g < s hangs
/// together and M the largest gradient of g anywhere. So all points within half the thickness of the struts'
/// axes, the paths along which g <= s, are solid.
///
/// A graded period squeezes and shears the pattern far from the centre: over a change of place dp the angles
/// change by (dp - (p - c) (grad period . dp) / period) 2 pi / period. Walls there may be thinner than asked
/// by as much as 1 + |p - c| |grad period| / period; keep that near 1, or grade the thickness along with it.
struct TpmsSettings {
    TpmsKind kind = TpmsKind::gyroid;
    bool network = false;  ///< solid on the side g < level of one surface; otherwise a sheet
    GradingPtr period;     ///< mm
    GradingPtr thickness;  ///< of the sheet's wall or of the network's struts at least, mm
    Box region;            ///< where it is wanted, mm; finite; slices are cut to it
};

/// The solid, which fills space; the region is its bounds, and only there are runs made. With one period and
/// one thickness over the region the runs are closed forms and the metric is `bound`. Otherwise the metric is
/// `sign`, and runs are found by a walk along the lines (walk_lines) that sees what is wider than a quarter
/// pixel; how steep the gradings are it takes from their differences over 1/16 of the region, with half as
/// much again for safety. Throws InputError for numbers out of range over the region: not
/// positive, more than 10,000 periods along a side, or so thick that nothing is left open.
FieldPtr make_tpms(const TpmsSettings& settings);

/// The greatest thickness, in periods, that leaves something open.
double greatest_tpms_thickness(TpmsKind kind, bool network);

}  // namespace lamella
