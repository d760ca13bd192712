// What tests of the overhang survey share.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/overhang_survey.h"
#include "tests/engine/island_scenes.h"

namespace lamella::overhangs {

inline constexpr double height = 0.2;  // of a layer

inline OverhangSurveyOptions without_stability() {
    OverhangSurveyOptions options;
    options.stability.reset();
    options.threads = 2;
    return options;
}

/// Whether a point not above p lies within `distance` of it.
inline bool near_point(const OverhangSurvey& survey, dvec3 p, double distance) {
    return std::any_of(survey.points.begin(), survey.points.end(), [&](const SupportPoint& s) {
        return s.at.z <= p.z + 1e-9 && glm::length(s.at - p) <= distance;
    });
}

}  // namespace lamella::overhangs
