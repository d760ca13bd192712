// From the recipe's [[region]] entries to solids and numbers that hold inside them.
#pragma once

#include <string>
#include <vector>

#include "recipe/build/build_gradings.h"

namespace lamella {

struct BuiltRegion {
    std::string name;  ///< "region 2 (`heel`)", for messages
    RegionMake make;
    double blend;  ///< mm
    /// Where it blends, its value is the distance to its surface or bounds it; a formula's is divided by its
    /// greatest slope at the surface.
    FieldPtr field;
};

struct BuiltRegions {
    std::vector<BuiltRegion> list;
    std::vector<std::string> warnings;  ///< regions that change nothing; what was mended in their meshes
};

/// The regions of a part inside the box, the numbers of those that change foam or skin handed to the
/// gradings. Throws InputError when a field cannot be made.
BuiltRegions build_regions(const Recipe& recipe, const Box& part, Gradings& gradings);

/// The part with its solid and empty regions, in their order, within the body; `filled`: the part is not
/// solid throughout. Warns of regions that do not touch the body. Throws InputError when nothing is left.
FieldPtr with_regions(FieldPtr part, const FieldPtr& body, bool filled, BuiltRegions& regions);

}  // namespace lamella
