// What is on a sheet to be cut: paths with a purpose, in millimetres, whatever file says it.
#pragma once

#include <string>
#include <vector>

#include "engine/base/archive.h"
#include "engine/base/geometry.h"

namespace lamella {

/// What a cutter does along a path, in the order in which it is done.
enum class CutPurpose : unsigned char {
    engrave,  ///< layer numbers
    score,    ///< outlines of the layer above
    inner,    ///< cut, within another contour
    outer     ///< cut that frees a piece from the sheet
};
inline constexpr int cut_purposes = 4;

struct SheetPath {
    void serialize(Archive& parcel) { parcel(purpose, layer, closed, points); }

    CutPurpose purpose = CutPurpose::outer;
    int layer = 0;
    bool closed = true;         ///< without a repeated last point
    std::vector<dvec2> points;  ///< mm
};

/// One sheet of material: its lower left corner at the origin, y upwards.
struct Sheet {
    std::string id;     ///< "layer0042", "sheet001"
    std::string label;  ///< for people
    dvec2 size{0};      ///< mm
    std::vector<SheetPath> paths;
};

/// Orders the paths of a sheet by purpose, and keeps their order otherwise.
void order_by_purpose(std::vector<SheetPath>& paths);

}  // namespace lamella
