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

/// Parameters of a triply periodic solid. The angles at a point p are (p - c) 2 pi / period(p), where c is
/// the region's centre.
///
/// A sheet holds the points within half of `thickness` of the surface g = 0. So the wall has this thickness
/// everywhere, and its volume is that of a parallel body: area times thickness, plus the small term of the
/// surface's curvature.
///
/// A network is g < level, with the lowest level at which all points within half of `thickness` of the
/// struts' axes are solid. The axes are the straight lines between the minima of g, over its saddles. So a
/// strut is thinnest, near its saddle, by exactly `thickness`.
///
/// A graded period compresses and shears the pattern far from the centre: over a displacement dp the angles
/// change by (dp - (p - c) (grad period . dp) / period) 2 pi / period. Walls there may be thinner than wanted
/// by a factor of up to 1 + |p - c| |grad period| / period; keep that near 1, or grade the thickness along
/// with it.
struct TpmsSettings {
    TpmsKind kind = TpmsKind::gyroid;
    bool network = false;  ///< solid on the side g < level of one surface; otherwise a sheet
    GradingPtr period;     ///< mm
    /// thickness of the sheet's wall, or minimum thickness of the network's struts, mm
    GradingPtr thickness;
    Box region;  ///< where the solid is wanted, mm; must be finite; slices are clipped to it
};

/// Makes the solid. It fills space; the region is its bounds, and runs are only made there. If period and
/// thickness are constant over the region, the runs of one period per line are found and repeated: a
/// network's to 1e-8 periods, a sheet's to 1.6e-5, as its distances are tabulated in each plane. The metric
/// is `bound` then; a sheet's features below 1/224 of the period may be missed. Otherwise the metric is
/// `sign`, and runs are found by walk_lines, which sees features wider than a quarter pixel. It estimates the
/// slopes of the gradings from differences over 1/16 of the region, times 1.5 for safety.
/// Throws InputError for numbers out of range over the region: not positive, more than 10,000 periods along a
/// side, or so thick that nothing is left open (see
/// greatest_tpms_thickness).
FieldPtr make_tpms(const TpmsSettings& settings);

/// Returns the maximum thickness, in periods: beyond it a sheet leaves nothing open, and a network's open
/// side is no longer connected.
double greatest_tpms_thickness(TpmsKind kind, bool network);

}  // namespace lamella
