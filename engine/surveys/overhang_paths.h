// Overhang paths: walks along outlines and places support points where they would hang.
#pragma once

#include <vector>

#include "engine/surveys/overhang_layer.h"
#include "engine/surveys/overhang_survey.h"
#include "engine/surveys/support_placer.h"

namespace lamella {

/// The inputs for one layer.
struct PathQuestion {
    const SurveyedLayer& layer;
    const SurveyResolution& by;
    const OverhangLimits& limits;
    const Field* enforced = nullptr;          ///< may be null
    double z = 0;                             ///< lower side of the layer, mm
    const std::vector<double>& stand_out;     ///< of each sample over the layer below, mm
    const std::vector<std::uint8_t>& island;  ///< by piece
};

struct PathFindings {
    double hanging_length = 0;       ///< mm
    std::size_t own_bridges = 0;     ///< hanging stretches of paths that bridge straight from end to end
    std::vector<dvec2> bridge_ways;  ///< unit directions of these bridges
};

/// Walks along the paths of a layer and places support points on hanging stretches.
PathFindings hold_paths(const PathQuestion& question, SupportPlacer& placer);

/// Within `enforced` the allowed overhang is this share of the usual one.
inline constexpr double enforced_share = 0.1;

}  // namespace lamella
