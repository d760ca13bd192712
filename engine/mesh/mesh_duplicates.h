// Removal of duplicate triangles.
#pragma once

#include <cstddef>

#include "engine/mesh/mesh.h"

namespace lamella {

/// Treatment of two triangles on the same corners that face opposite ways.
enum class BackToBack { cancel, keep_one };

struct DroppedDuplicates {
    std::size_t copies = 0;     ///< further triangles with the same corners and orientation
    std::size_t cancelled = 0;  ///< triangles that lay back to back with another one
};

/// Removes copies, and pairs back to back. Copies stay if removing them would leave more edges open: two
/// solids that share a piece of surface both need it.
DroppedDuplicates drop_duplicates(TriangleMesh& mesh, BackToBack back_to_back);

struct CancelledCaps {
    std::size_t caps = 0;    ///< caps removed
    std::size_t others = 0;  ///< mesh triangles removed: their own backs were all that closed them
};

/// Removes pairs of triangles back to back of which at least one is among the last `caps`; the others keep
/// their order.
CancelledCaps cancel_caps(TriangleMesh& mesh, std::size_t caps);

/// Removes the vertices that no triangle uses; the others keep their order.
void drop_unused_vertices(TriangleMesh& mesh);

}  // namespace lamella
