// What tests of the overhang survey share.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/surveys/overhang_survey.h"
#include "tests/engine/surveys/island_scenes.h"

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

/// Whether the part lies within `reach` of q in the plane at height z: the field asked on a disc.
inline bool disc_meets(const Field& part, dvec2 q, double z, double reach) {
    for (int r = 0; r <= 8; ++r) {
        for (int k = 0; k < 32; ++k) {
            const double a = 2 * 3.14159265358979323846 * k / 32, d = reach * r / 8;
            if (part.value({q.x + d * std::cos(a), q.y + d * std::sin(a), z}) < 0) return true;
        }
    }
    return false;
}

}  // namespace lamella::overhangs
