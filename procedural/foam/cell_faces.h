// The faces of a Voronoi cell as rings of nodes, the same from both sides.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "procedural/foam/foam_beams.h"

namespace lamella {

/// Lists the faces of cells. A ring of nodes begins at the edge whose seed beyond has the lowest key, and
/// turns as seen from outside the cell with the lower key of the two that share the face: so both list it
/// alike. Not thread-safe; keeps buffers for reuse.
class CellFaces {
  public:
    enum class Which : std::uint8_t {
        owned,  ///< towards seeds of higher keys
        all
    };
    struct Face {
        SeedKey other;                ///< of the seed beyond the face
        std::span<const dvec3> ring;  ///< in the part's space
    };

    /// Lists a cell's faces in the order of the other seeds' keys. The cell's identifiers index `sites`.
    /// Returns the number of edges that are left out because they reach the start box, and of faces that make
    /// no ring without them.
    std::size_t list(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
                     const Stretch& stretch, Which which);
    std::span<const Face> faces() const { return faces_; }

  private:
    /// An edge of a face in the face's sense of turning, with the seed beyond it.
    struct Edge {
        const Seed* face;
        const Seed* beyond;  ///< null: the start box
        std::size_t from, to;
    };
    std::size_t collect_edges(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
                              Which which);
    bool order(std::span<const Edge> edges);

    CellNodes nodes_;
    std::vector<Edge> edges_;
    std::vector<std::size_t> ring_;  ///< the cell's vertices round a face
    std::vector<dvec3> corners_;     ///< of all faces, ring after ring
    std::vector<Face> faces_;
};

}  // namespace lamella
