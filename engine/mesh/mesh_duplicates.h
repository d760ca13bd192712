// Triangles that are there more than once.
#pragma once

#include <cstddef>

#include "engine/mesh/mesh.h"

namespace lamella {

/// What to do with two triangles on the same corners that face opposite ways.
enum class BackToBack { cancel, keep_one };

struct DroppedDuplicates {
    std::size_t copies = 0;     ///< further triangles with the same corners and the same side
    std::size_t cancelled = 0;  ///< triangles that faced another one
};

/// Removes copies, and pairs back to back. Copies stay when without them more edges would be left open: two
/// solids that share a piece of surface both need it.
DroppedDuplicates drop_duplicates(TriangleMesh& mesh, BackToBack back_to_back);

/// Removes pairs of triangles back to back of which at least one is among the last `caps`; the order of the
/// others stays.
struct CancelledCaps {
    std::size_t caps = 0;    ///< caps that went
    std::size_t others = 0;  ///< triangles of the mesh that went: they were closed by nothing but their backs
};
CancelledCaps cancel_caps(TriangleMesh& mesh, std::size_t caps);

/// Removes the vertices that no triangle uses; the order of the others stays.
void drop_unused_vertices(TriangleMesh& mesh);

}  // namespace lamella
