// Scaffold: bridges on pillars that support a part while it is printed (Dumas, Hergel and Lefebvre 2014;
// thesis 3.1), as plain data.
#pragma once

#include <string>
#include <vector>

#include "engine/field/field.h"
#include "engine/solids/beam.h"
#include "engine/surveys/support_point.h"

namespace lamella {

/// Dimensions of a scaffold. Lengths in mm.
struct ScaffoldShape {
    double bed = 0;                ///< height of the bed
    double layer_height = 0.2;     ///< flat faces lie on layer boundaries, counted from the bed
    bool bridges = true;           ///< false: a pillar under every point
    double bridge = 12;            ///< maximum length of a bar
    double reach = 4;              ///< maximum lateral extent of a connector
    double lean = 1;               ///< maximum lateral distance per mm of height, for leaning pieces
    double connector = 2;          ///< minimum height of a connector
    double longest_connector = 8;  ///< maximum height of a connector that stands on a bar
    double clearance = 0.5;        ///< from the part, except at contacts
    double gap = 0;                ///< between the tip of a connector and the part
    double tip = 0.6;              ///< diameter of a connector at its contact with the part
    double pillar = 2.5;           ///< width of a pillar
    bool round_pillars = false;    ///< round instead of two crossed walls
    double wall = 0.45;            ///< thickness of crossed walls
    double bar_width = 0.9;
    double bar_height = 0.6;   ///< rounded up to whole layers in a scaffold
    double foot = 6;           ///< maximum diameter of a pillar's foot on the bed; less under low pillars
    double foot_height = 0.2;  ///< also rounded up to whole layers; a brim adheres by its area

    friend bool operator==(const ScaffoldShape&, const ScaffoldShape&) = default;
};

/// A horizontal bar. `a` and `b` are the ends of its upper side.
struct ScaffoldBar {
    dvec3 a{0};
    dvec3 b{0};
    friend bool operator==(const ScaffoldBar&, const ScaffoldBar&) = default;
};

/// A vertical pillar.
struct ScaffoldPillar {
    dvec2 at{0};
    double bottom = 0;
    double top = 0;
    double foot = 0;  ///< radius of its foot; 0 if it does not stand on the bed
    friend bool operator==(const ScaffoldPillar&, const ScaffoldPillar&) = default;
};

struct Scaffold {
    ScaffoldShape shape;
    std::vector<SupportPoint> points;  ///< all requested points
    /// indices of points that no support can reach without touching the part
    std::vector<std::size_t> unheld;
    std::vector<ScaffoldBar> bars;
    std::vector<ScaffoldPillar> pillars;  ///< those on the bed have a foot each
    std::vector<Beam> connectors;  ///< leaning pieces: to points, to bars, around obstacles, onto the part
};

}  // namespace lamella
