// Sheet: paths to be cut, scored or engraved, in millimetres, independent of the file format.
#pragma once

#include <string>
#include <vector>

#include "engine/base/archive.h"
#include "engine/base/geometry.h"

namespace lamella {

/// Operation of the cutter along a path. The values are in the order of execution.
enum class CutPurpose : unsigned char {
    engrave,  ///< layer numbers
    score,    ///< outlines of the layer above
    inner,    ///< cut, within another contour
    outer     ///< cut that separates a piece from the sheet
};
inline constexpr int cut_purposes = 4;

struct SheetPath {
    void serialize(Archive& parcel) { parcel(purpose, layer, closed, points); }

    CutPurpose purpose = CutPurpose::outer;
    int layer = 0;
    bool closed = true;         ///< closed paths do not repeat the first point
    std::vector<dvec2> points;  ///< mm
};

/// A sheet of material. The origin is its lower left corner, y points upwards.
struct Sheet {
    std::string id;     ///< such as "layer0042" or "sheet001"
    std::string label;  ///< title for people
    dvec2 size{0};      ///< mm
    std::vector<SheetPath> paths;
};

/// Sorts the paths of a sheet by purpose. The sort is stable.
void order_by_purpose(std::vector<SheetPath>& paths);

}  // namespace lamella
