// Tip survey: finds what begins in the air and soon joins what is held, in one streaming pass over a job's
// layers.
#pragma once

#include <memory>
#include <vector>

#include "engine/layers/layer_stream.h"
#include "engine/runs/run_boxes.h"

namespace lamella {

/// A tip: pieces of layers, from one that touches nothing of the layer below up to where they all join what
/// began earlier.
struct HangingTip {
    dvec3 at{0};          ///< a point of its largest layer, mm
    dvec3 begin{0};       ///< a point of its first layer, mm
    double height = 0;    ///< of its layers together, mm
    double area = 0;      ///< of its largest layer, mm^2
    int first_layer = 0;  ///< [first_layer, end_layer)
    int end_layer = 0;
};

struct TipSurveyOptions : PassControl {
    double pitch = 0.05;                          ///< mm from one surveyed row to the next
    double height = 0.2;                          ///< mm: no higher tips are trimmed; negative: none are
    double contact = 0.1;                         ///< mm across: of what holds; 0: whatever touches, holds
    std::size_t max_kept = std::size_t{1} << 24;  ///< most runs of tips in memory; 16 bytes each
    std::size_t report_kept = 10;
};

struct TipSurvey {
    std::size_t trimmed = 0;       ///< tips that are to be removed
    double volume = 0;             ///< of them, mm^3
    std::size_t higher = 0;        ///< tips that begin in the air and stay because they are too high
    std::size_t holding = 0;       ///< tips that stay because pieces of the part hang together by them alone
    std::vector<HangingTip> kept;  ///< the highest few of those that stay
    std::vector<dvec3> on_bed;     ///< a point of each piece of the lowest layer that holds anything, mm
    std::vector<dvec3> begins;     ///< where tips that stay begin in the air or on less than what holds, mm
    /// Runs of the tips that are to be removed, grown by two pitches within their layers. Never null. Layer l
    /// of the job lies between heights l and l + 1 of the boxes' grid.
    std::shared_ptr<const RunBoxes> removed;
};

/// Surveys all layers of a job, which are one stack, at their cutting planes: exact along x, with one row per
/// `pitch` in y. The lowest layer that holds anything is held by the bed.
///
/// Rectangles of `contact` along the rows, and of so many rows as to be as wide, tell what is firm: a
/// morphological opening. The pieces of a layer are the connected components of what is firm, and of the
/// slivers left beside it. A sliver that touches firm pieces belongs to the oldest of them. A firm piece is
/// held by pieces of the layer below with which it shares something firm, a sliver by itself by one on which
/// half of it lies. With a `contact` of 0 all is firm, and held by whatever it touches: overlapping or
/// touching runs in the same row or the next.
///
/// A piece belongs to the oldest of the tips that hold it, or to what is held, which is older than all tips;
/// if nothing holds it, it begins a tip. Tips that begin on less than what holds count as older than those
/// that begin in the air. So tips end where they join something older. Tips of one layer, or as high as
/// `height` at most, are to be removed, unless pieces of the part that are connected would be connected no
/// more, or a tip that stays begins on them or beside them: of several such tips that touch each other, all
/// stay.
///
/// Every piece that stays is held by one that stays, unless it began a tip before. So removing tips makes no
/// new ones, and takes away nothing but what hung. Grown runs keep off other pieces of the layer: between
/// them, a row is divided in the middle.
///
/// The result is a pure function of job, pitch and height, independent of the number of threads. Memory
/// depends on a few layers' runs and on the tips, not on the number of layers. Throws InputError when the
/// pitch does not suit the job (survey_pitch_range), the job has several stacks of layers, or tips have more
/// runs than `max_kept`; Interrupted when cancelled.
TipSurvey survey_tips(const Job& job, const TipSurveyOptions& options);

}  // namespace lamella
