// Contours made by hand for the tests of toolpaths.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "engine/contours/contours.h"

namespace lamella::test {

inline Contour box_contour(dvec2 lo, dvec2 hi) { return {{lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}, -1, false}; }

inline Contour disc_contour(dvec2 center, double radius, int corners = 120) {
    Contour contour;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * 3.14159265358979 * i / corners;
        contour.points.push_back(center + radius * dvec2(std::cos(angle), std::sin(angle)));
    }
    return contour;
}

/// A strip of constant thickness round an arc.
inline Contour arc_contour(dvec2 center, double radius, double thickness, double from, double to) {
    Contour contour;
    constexpr int steps = 60;
    for (int i = 0; i <= steps; ++i) {
        const double angle = from + (to - from) * i / steps;
        contour.points.push_back(center + (radius + thickness / 2) * dvec2(std::cos(angle), std::sin(angle)));
    }
    for (int i = steps; i >= 0; --i) {
        const double angle = from + (to - from) * i / steps;
        contour.points.push_back(center + (radius - thickness / 2) * dvec2(std::cos(angle), std::sin(angle)));
    }
    return contour;
}

inline Contour as_hole(Contour contour, int parent) {
    contour.points = {contour.points.rbegin(), contour.points.rend()};
    contour.hole = true;
    contour.parent = parent;
    return contour;
}

/// Shoelace formula.
inline double area_of(const Contour& contour) {
    double twice = 0;
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
        const dvec2 a = contour.points[i];
        const dvec2 b = contour.points[(i + 1) % contour.points.size()];
        twice += a.x * b.y - b.x * a.y;
    }
    return twice / 2;
}

/// Even-odd rule over all contours.
inline bool inside(const std::vector<Contour>& contours, dvec2 p) {
    bool in = false;
    for (const Contour& contour : contours) {
        for (std::size_t i = 0; i < contour.points.size(); ++i) {
            const dvec2 a = contour.points[i];
            const dvec2 b = contour.points[(i + 1) % contour.points.size()];
            if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) in = !in;
        }
    }
    return in;
}

}  // namespace lamella::test
