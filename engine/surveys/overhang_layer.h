// SurveyedLayer: the data of a layer that the overhang survey keeps until the next layer is compared with it.
#pragma once

#include "engine/contours/contour_index.h"
#include "engine/layers/backend.h"
#include "engine/runs/run_components.h"

namespace lamella {

struct OverhangLimits;

/// The sampling of layers by the overhang survey. Lengths in mm.
struct SurveyResolution {
    SurveyResolution(const Job& job, const OverhangLimits& limits);

    RowBand band;      ///< rows over the whole job
    double tolerance;  ///< of outlines
    double step;       ///< greatest distance of two samples of an outline
    double width;      ///< of a bead
    double overhang;   ///< distance by which a layer may stand out over the one below
    double growth;     ///< dilation of the rows that carry the inside of the next layer
};

/// A sample point of an outline.
struct OutlineSample {
    dvec2 at;
    dvec2 inward;  ///< unit normal
};

inline constexpr std::uint32_t no_piece = UINT32_MAX;

/// A closed path: an outline sampled in even steps.
struct OutlinePath {
    std::size_t first = 0;           ///< index of its first sample
    std::size_t count = 0;           ///< number of samples, at least 4
    double step = 0;                 ///< mm
    std::uint32_t piece = no_piece;  ///< the layer's piece that it bounds; no_piece if too thin for the rows
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
    RunRows rows;   ///< without lines if there is no layer
    RunRows grown;  ///< `rows` dilated by a disc
    LabelledLayer labelled;
    std::vector<LayerPiece> pieces;

    /// Returns the signed distance of p from this layer, mm, negative inside: by how much p stands out. Plus
    /// or minus infinity if the layer's border is farther than the resolution's overhang.
    double stand_out(dvec2 p, const SurveyResolution& by) const;
    /// Returns the piece of the layer at p, or within about a row of it; no_piece if there is none.
    std::uint32_t piece_at(dvec2 p, const RowBand& band) const;
    /// Returns the point of a piece's rows that is nearest to its centroid.
    dvec2 middle(std::uint32_t piece, const RowBand& band) const;
    /// Returns the centre of the bead along the outline: half a width inside, or midway through a thinner
    /// wall.
    dvec2 bead(const OutlineSample& sample, double width) const;
};

/// Samples a layer by itself. Pure.
std::unique_ptr<SurveyedLayer> survey_layer(const Layer& layer, const SurveyResolution& by);

}  // namespace lamella
