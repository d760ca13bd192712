// The data of a layer that the overhang survey keeps until it has compared the next one.
#pragma once

#include "engine/contours/contour_index.h"
#include "engine/layers/backend.h"
#include "engine/runs/run_components.h"

namespace lamella {

struct OverhangLimits;

/// How finely a survey looks at layers. Lengths in mm.
struct SurveyResolution {
    SurveyResolution(const Job& job, const OverhangLimits& limits);

    RowBand band;      ///< rows over the whole job
    double tolerance;  ///< of outlines
    double step;       ///< from sample to sample of an outline, at most
    double width;      ///< of what is laid at once
    double overhang;   ///< by which a layer may stand out over the one below
    double growth;     ///< by which rows are grown that say where the next layer is held inside
};

/// A place of an outline.
struct OutlineSample {
    dvec2 at;
    dvec2 inward;  ///< unit normal
};

inline constexpr std::uint32_t no_piece = UINT32_MAX;

/// A closed path: an outline in even steps.
struct OutlinePath {
    std::size_t first = 0;           ///< of its samples
    std::size_t count = 0;           ///< at least 4
    double step = 0;                 ///< mm
    std::uint32_t piece = no_piece;  ///< of the layer; none where it is too thin for the rows
};

/// A connected piece of a layer.
struct LayerPiece {
    double area = 0;  ///< mm^2
    dvec2 moment{0};  ///< area times its centre, mm^3
};

/// A layer as surveyed.
struct SurveyedLayer : LayerProduct {
    std::vector<OutlineSample> samples;
    std::vector<OutlinePath> paths;
    ContourIndex border;
    RunRows rows;   ///< empty without a line where there is no layer
    RunRows grown;  ///< the same grown by a disc
    LabelledLayer labelled;
    std::vector<LayerPiece> pieces;

    /// By how much p stands out over this layer, mm: negative inside; plus or minus infinity where its border
    /// is further than the resolution's overhang.
    double stand_out(dvec2 p, const SurveyResolution& by) const;
    /// The piece of the layer at or beside p, within a row.
    std::uint32_t piece_at(dvec2 p, const RowBand& band) const;
    /// A place in a piece, as near to its centre as its rows come.
    dvec2 middle(std::uint32_t piece, const RowBand& band) const;
    /// Where the middle of what is laid along the outline lies: half a width inside, or midway through what
    /// is thinner.
    dvec2 bead(const OutlineSample& sample, double width) const;
};

/// Surveys a layer by itself. Pure.
std::unique_ptr<SurveyedLayer> survey_layer(const Layer& layer, const SurveyResolution& by);

}  // namespace lamella
