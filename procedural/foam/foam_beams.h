// BeamMaker: makes the beam of each Voronoi edge once, with end points that all adjacent cells agree on.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "procedural/foam/tapered_beams.h"
#include "procedural/voronoi/cell_search.h"
#include "procedural/voronoi/stretch.h"

namespace lamella {

/// Returns the point at equal distance from four seeds, given in key order. One formula, relative to the
/// first seed, so every cell that shares the node computes the same bits. Uses twice the precision if the
/// seeds are nearly coplanar. Empty if they are coplanar.
std::optional<dvec3> circumcenter(const std::array<dvec3, 4>& seeds);

/// The canonical positions of a cell's nodes, on which all cells that share a node agree. Keeps buffers for
/// reuse.
class CellNodes {
  public:
    /// Starts a new cell and forgets the nodes of the last one.
    void start(const VoronoiCell& cell);
    /// Returns the node at a vertex whose three planes belong to seeds. `cell` is the one passed to start().
    dvec3 at(const VoronoiCell& cell, std::size_t vertex, const Seed& own, std::span<const Seed> sites);

  private:
    std::vector<dvec3> nodes_;
    std::vector<bool> known_;
};

/// Makes the beams that a cell owns: those along its edges whose two other seeds have higher keys than its
/// own. Not thread-safe; keeps buffers for reuse.
class BeamMaker {
  public:
    using Piece = Beam;
    /// `radius` is sampled at the nodes in part space, after the stretch.
    explicit BeamMaker(NodeRadius radius, const Stretch& stretch = {})
        : tapered_(std::move(radius)), stretch_(stretch) {}

    double largest_growth() const { return tapered_.radius().largest(); }
    double growth(const Box& box) const { return tapered_.radius().largest_in(box); }
    bool avoids(const Box& /*box*/) const { return false; }
    const Stretch& stretch() const { return stretch_; }

    /// Appends the beams that `own` owns, in order of the other seeds' keys. The cell's plane identifiers
    /// index `sites`. Edges that reach the start box are skipped. If the four seeds of a node are coplanar
    /// and tie with a fifth, to within rounding, the node is taken from the cell; an edge shared by four or
    /// more cells may then be made more than once, in the same place. Returns the number of skipped edges.
    std::size_t append(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
                       std::vector<Beam>& beams);
    /// Appends the beam along an edge between two nodes in part space.
    void append_edge(dvec3 from, dvec3 to, std::vector<Beam>& beams) {
        tapered_.add(from, to);
        tapered_.append(beams);
    }

  private:
    struct Edge {
        const Seed* second;
        const Seed* third;
        std::size_t from, to;
    };
    TaperedBeams tapered_;
    Stretch stretch_;
    std::vector<Edge> edges_;
    CellNodes nodes_;
};

}  // namespace lamella
