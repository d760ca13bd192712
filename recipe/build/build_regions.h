// Makes the recipe's [[region]] entries: solids, and numbers that hold inside them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "recipe/build/build_gradings.h"

namespace lamella {

struct BuiltRegion {
    std::string name;  ///< "region 2 (`heel`)", for messages
    RegionMake make;
    double blend;  ///< mm
    /// If `blend` is positive, its value is the distance to its surface or a bound of it; a formula's is
    /// divided by its greatest slope at the surface.
    FieldPtr field;
    std::string tool{};       ///< name of the [[tool]] that makes what is in the region; empty: as around it
    double layer_height = 0;  ///< mm; 0: as around it
};

struct BuiltRegions {
    std::vector<BuiltRegion> list;
    std::vector<std::string> warnings;  ///< regions without effect; repairs of their meshes
};

/// All regions, or those that do not depend on the result of the recipe's search.
enum class WhichRegions : std::uint8_t { all, before_search };

/// Makes the regions of a part inside the box, and registers numbers of foam and skin regions as overrides
/// with the gradings. Throws InputError when a field cannot be made, such as one that depends on the result
/// of the recipe's search while the gradings have none.
BuiltRegions build_regions(const Recipe& recipe, const Box& part, Gradings& gradings,
                           WhichRegions which = WhichRegions::all);

/// Returns the same regions where they are once the part is turned about the origin by orthogonal axes;
/// `part` encloses the turned part.
BuiltRegions turned_regions(const Recipe& recipe, const Box& part, Gradings& gradings,
                            const glm::dmat3& axes);

/// Returns the part with its solid and empty regions applied in order, clipped by the body. `filled`: the
/// part is not solid throughout. Warns of regions that do not touch the body. Throws InputError when nothing
/// remains.
FieldPtr with_regions(FieldPtr part, const FieldPtr& body, bool filled, BuiltRegions& regions);

}  // namespace lamella
