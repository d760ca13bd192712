// The overhang survey: one streaming pass over a job's layers that finds what would hang in the air, or
// topple, while it is printed.
#pragma once

#include <optional>
#include <vector>

#include "engine/layers/layer_stream.h"
#include "engine/surveys/print_stability.h"
#include "engine/surveys/support_point.h"

namespace lamella {

/// What can be printed without help. Lengths in mm.
struct OverhangLimits {
    double overhang = 0.225;  ///< by which a layer may stand out over the one below
    double width = 0.45;      ///< of what is laid at once; paths lie half of it inside the outline
    double spacing = 3;  ///< a support point holds what lies within this distance, at its height or above
    double free_stretch = 1;  ///< of a path that may hang unheld
    double bridge = 10;       ///< a straight stretch up to this length, held at both ends, needs no support
};

struct OverhangSurveyOptions : PassControl {
    OverhangLimits limits;
    std::optional<StabilityLimits> stability = StabilityLimits{};  ///< empty: not looked at
    bool on_bed = true;                                            ///< whether the first layer needs no hold
    FieldPtr blocked;                                              ///< no points in it; may be null
    FieldPtr enforced;  ///< in it all that stands out over the layer below is held; may be null
};

struct OverhangSurvey {
    std::vector<SupportPoint> points;  ///< by height, then in the order of the paths
    double hanging_length = 0;         ///< of paths that nothing below holds, mm
    std::size_t own_bridges = 0;       ///< stretches left to hang between their ends
    std::size_t blocked = 0;           ///< points left out
    std::optional<double> topples_at;  ///< height over the bed from which no further point helps, mm; empty:
                                       ///< it stands
};

/// Surveys all layers of a job's part, each against the one below.
///
/// A place of an outline is held when it stands out by at most `overhang`, or when a point within `spacing`,
/// not above it, holds it. Where an outline is not held for longer than the free stretch, points come half a
/// width inside it; but for a run that the layer below holds at both ends, and that in between lies within
/// half a width of a straight line no longer than a bridge. What begins with nothing below has a point at
/// least. Ceilings further than a width from the outline have points a spacing apart, unless one direction
/// leads everywhere from hold to hold within the length of a bridge. Outlines are known to an eighth of the
/// width; what is thinner than a quarter of it may be missed as a piece of its own.
///
/// When the print would topple, points are added where the outline faces down and reaches furthest out, in 16
/// directions; they may lie below the layer that needs them. A pure function of part, layers and options, the
/// same by any number of threads. Memory depends on a few layers and on the points, not on the number of
/// layers. Throws InputError when the limits make no sense, Interrupted when cancelled.
OverhangSurvey survey_overhangs(const Job& job, const OverhangSurveyOptions& options);

}  // namespace lamella
