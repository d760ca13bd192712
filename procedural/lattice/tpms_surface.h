// The functions g whose zero sets are the triply periodic surfaces: values, waves along lines, intervals.
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

/// What the settings' laws need to know of a function g. All four are antisymmetric: shifted by half a period
/// along some axes, g becomes -g.
struct TpmsConstants {
    double steepest;          ///< the largest gradient anywhere, angles
    double steepest_along;    ///< the largest derivative along one axis
    double steepest_surface;  ///< the largest gradient on g = 0
    double joined;            ///< the least level at which g < level hangs together
    double greatest;          ///< the largest |g|
};
TpmsConstants tpms_constants(TpmsKind kind);

/// g along a line in the direction `axis` of a plane, from the sines and cosines of the angle across the line
/// and of the plane's height.
Wave tpms_wave(TpmsKind kind, Axis axis, const SineCosine& across, const SineCosine& z);

/// Encloses g over the box of angles; infinite sides are allowed.
Interval tpms_range(TpmsKind kind, const Box& angles);

}  // namespace lamella
