// Estimate of the memory that a run will need, computed before it starts.
#pragma once

#include <cstdint>

#include "recipe/build/build_job.h"

namespace lamella {

/// An estimate in bytes, within a third of the measured peak on the parts to which it was fitted. It depends
/// on the plate's area, the layers in flight and the cells near them, never on the number of layers.
struct MemoryBound {
    int layers_in_flight = 0;
    double beams_per_layer = 0;      ///< beams whose z range meets one plane
    std::int64_t layer_bytes = 0;    ///< one layer in flight: its beams, row buffers and finished page
    std::int64_t cell_bytes = 0;     ///< foam cells near the layers in flight
    std::int64_t mesh_bytes = 0;     ///< vertices, triangles and their index over z, during reading
    std::int64_t picture_bytes = 0;  ///< the grid for the file's picture
    std::int64_t base_bytes = 0;     ///< the program and its libraries
    std::int64_t total() const {
        return base_bytes + mesh_bytes + picture_bytes + cell_bytes + layers_in_flight * layer_bytes;
    }
};

/// `threads` 0: one per core.
MemoryBound memory_bound(const Recipe& recipe, const BuiltJob& built, int threads);

}  // namespace lamella
