// CellFaces: the faces of a Voronoi cell as rings of nodes, the same from both sides.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "procedural/foam/foam_beams.h"

namespace lamella {

/// Lists the faces of cells. Both cells at a face list the same ring of nodes: it starts at the edge whose
/// seed beyond has the lowest key, and is counter-clockwise seen from outside the cell with the lower key.
/// Not thread-safe; keeps buffers for reuse.
class CellFaces {
  public:
    enum class Which : std::uint8_t {
        owned,  ///< shared with seeds of higher keys
        all
    };
    struct Face {
        SeedKey other;                ///< key of the seed across the face
        std::span<const dvec3> ring;  ///< corners in part space
    };

    /// Lists a cell's faces in order of the other seeds' keys. The cell's plane identifiers index `sites`.
    /// Returns the number of edges skipped because they reach the start box, plus the number of faces that
    /// are not closed rings without them.
    std::size_t list(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
                     const Stretch& stretch, Which which);
    std::span<const Face> faces() const { return faces_; }

  private:
    /// A directed edge of a face, in the direction of its ring, with the seed beyond it.
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
    std::vector<std::size_t> ring_;  ///< vertices of the cell around one face
    std::vector<dvec3> corners_;     ///< of all faces, ring after ring
    std::vector<Face> faces_;
};

}  // namespace lamella
