// Overhang survey: finds where a print would hang in the air or topple, and places support points, in one
// streaming pass over a job's layers.
#pragma once

#include <optional>
#include <vector>

#include "engine/layers/layer_stream.h"
#include "engine/surveys/print_stability.h"
#include "engine/surveys/support_point.h"

namespace lamella {

/// The limits of printing without supports. Lengths in mm.
struct OverhangLimits {
    double overhang = 0.225;  ///< distance by which a layer may stand out over the one below
    double width = 0.45;      ///< of a bead; paths lie half of it inside the outline
    double spacing = 3;       ///< a support point carries everything within this distance, not below it
    double free_stretch = 1;  ///< length of a path that may hang without support
    double bridge = 10;       ///< a straight stretch up to this length, held at both ends, needs no support
};

struct OverhangSurveyOptions : PassControl {
    OverhangLimits limits;
    std::optional<StabilityLimits> stability = StabilityLimits{};  ///< empty: stability is not checked
    bool on_bed = true;                                            ///< the first layer lies on the bed
    FieldPtr blocked;   ///< no points are placed in it; may be null
    FieldPtr enforced;  ///< in it even slight overhangs get points (enforced_share); may be null
};

struct OverhangSurvey {
    std::vector<SupportPoint> points;  ///< by height, then in the order of the paths
    double hanging_length = 0;         ///< length of paths that the layer below does not carry, mm
    std::size_t own_bridges = 0;       ///< number of stretches left to bridge between their ends
    std::size_t blocked = 0;           ///< number of points left out because they are blocked
    std::optional<double> topples_at;  ///< height over the bed from which no further point helps, mm; empty:
                                       ///< it stands
};

/// Compares each layer of a job's part with the layer below it and places support points.
///
/// A sample of an outline is held if it stands out by at most `overhang`, or if a support point lies within
/// `spacing` of it and not above it. A stretch of an outline that is not held and longer than the free
/// stretch gets support points half a width inside. The exception is a bridge: a stretch that the layer below
/// carries at both ends and that lies within half a width of a straight line no longer than `bridge`. A piece
/// that begins with nothing below it gets at least one point. Ceilings farther than a width from the outline
/// get points `spacing` apart, unless in one direction all lines through them are bridges. Outlines are
/// sampled to an eighth of the width; a piece thinner than a quarter of it may be missed as a piece of its
/// own.
///
/// If the print would topple, points are added where the outline faces down and reaches farthest out, in 16
/// directions. These may lie below the layer that needs them.
///
/// A pure function of part, layers and options, independent of the number of threads. Memory depends on a few
/// layers and on the points, not on the number of layers. Throws InputError when a limit is out of range,
/// Interrupted when cancelled.
OverhangSurvey survey_overhangs(const Job& job, const OverhangSurveyOptions& options);

}  // namespace lamella
