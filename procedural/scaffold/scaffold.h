// Scaffold: bridges on pillars that hold a part while it is printed (Dumas, Hergel and Lefebvre 2014; thesis
// 3.1), as plain data and as a field.
#pragma once

#include <string>
#include <vector>

#include "engine/field/field.h"
#include "engine/solids/beam.h"
#include "engine/surveys/support_point.h"

namespace lamella {

/// How a scaffold is shaped. Lengths in mm.
struct ScaffoldShape {
    double bed = 0;                ///< height of the bed
    double layer_height = 0.2;     ///< flat faces lie between layers, counted from the bed
    bool bridges = true;           ///< false: a pillar under every point
    double bridge = 12;            ///< longest bar
    double reach = 4;              ///< by which a connector may lean sideways
    double lean = 1;               ///< sideways for each mm of height, at most, of leaning pieces
    double connector = 2;          ///< least height of a connector
    double longest_connector = 8;  ///< height of what stands on a bar
    double clearance = 0.5;        ///< from the part, contacts apart
    double gap = 0;                ///< between the tip of a connector and the part
    double tip = 0.6;              ///< diameter of a connector where it meets the part
    double pillar = 2.5;           ///< width of a pillar
    bool round_pillars = false;    ///< round instead of a cross of two walls
    double wall = 0.45;            ///< thickness of a cross's walls
    double bar_width = 0.9;
    double bar_height = 0.6;   ///< a scaffold has the next whole number of layers
    double foot = 6;           ///< diameter of a pillar's foot on the bed; less under low pillars
    double foot_height = 0.2;  ///< in whole layers, too; a brim sticks by its area

    friend bool operator==(const ScaffoldShape&, const ScaffoldShape&) = default;
};

/// A horizontal bar; its upper side lies at the height of its ends.
struct ScaffoldBar {
    dvec3 a{0};
    dvec3 b{0};
    friend bool operator==(const ScaffoldBar&, const ScaffoldBar&) = default;
};

/// An upright pillar.
struct ScaffoldPillar {
    dvec2 at{0};
    double bottom = 0;
    double top = 0;
    double foot = 0;  ///< radius of its foot; 0 where it does not stand on the bed
    friend bool operator==(const ScaffoldPillar&, const ScaffoldPillar&) = default;
};

struct Scaffold {
    ScaffoldShape shape;
    std::vector<SupportPoint> points;  ///< all that were asked for
    std::vector<std::size_t> unheld;   ///< points that nothing could be led to without touching the part
    std::vector<ScaffoldBar> bars;
    std::vector<ScaffoldPillar> pillars;  ///< on the bed a foot each
    std::vector<Beam> connectors;  ///< leaning pieces: to points, to bars, round obstacles, onto the part
};

}  // namespace lamella
