// The functions g whose zero sets are the triply periodic surfaces: values, waves along lines, and interval
// bounds.
#pragma once

#include <cmath>

#include "engine/base/deterministic_math.h"
#include "engine/runs/runs.h"
#include "procedural/lattice/tpms.h"

namespace lamella {

/// The function sine * sin t + cosine * cos t + constant of an angle t.
struct Wave {
    double sine;
    double cosine;
    double constant;
    double amplitude() const { return std::sqrt(sine * sine + cosine * cosine); }
    double at(const SineCosine& t) const { return sine * t.sine + cosine * t.cosine + constant; }
};

/// Constants of a function g that the formulas of tpms.h need. All four g are antisymmetric: shifted by half
/// a period along some axes, g becomes -g. Derivatives are those with respect to the angles.
struct TpmsConstants {
    double steepest;  ///< maximum gradient anywhere
    double sharpest;  ///< maximum second derivative along any direction
    double joined;    ///< lowest level at which g < level is connected
    double greatest;  ///< maximum of |g|
    double farthest;  ///< maximum distance of a point from g = 0, radians
};
TpmsConstants tpms_constants(TpmsKind kind);

/// Sines and cosines of a point's angles.
struct TpmsPoint {
    SineCosine x, y, z;
};

/// Returns a point of a line in the direction `axis` of a plane, given its angle along the line, the line's
/// across it and the plane's.
inline TpmsPoint tpms_point_on(Axis axis, const SineCosine& along, const SineCosine& across,
                               const SineCosine& z) {
    return axis == Axis::x ? TpmsPoint{along, across, z} : TpmsPoint{across, along, z};
}

/// Returns the point at the angles p.
TpmsPoint tpms_point(dvec3 p);

/// Returns the point that lies `offset` (radians) from another.
TpmsPoint tpms_point_beside(const TpmsPoint& point, dvec3 offset);

/// The value of g and its gradient.
struct TpmsSample {
    double g;
    dvec3 gradient;
};
TpmsSample tpms_sample(TpmsKind kind, const TpmsPoint& point);

/// Returns the second derivatives of g.
glm::dmat3 tpms_hessian(TpmsKind kind, const TpmsPoint& point);

/// Returns g along a line in the direction `axis` of a plane, given the sines and cosines of the angle across
/// the line and of that of the plane's height.
Wave tpms_wave(TpmsKind kind, Axis axis, const SineCosine& across, const SineCosine& z);

/// Returns bounds of g over a box of angles; infinite sides are allowed.
Interval tpms_range(TpmsKind kind, const Box& angles);

}  // namespace lamella
