// From cells to beams: each Voronoi edge made once, with ends that every cell agrees on.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "procedural/foam/tapered_beams.h"
#include "procedural/voronoi/cell_search.h"
#include "procedural/voronoi/stretch.h"

namespace lamella {

/// The point at equal distance from four seeds, which come in the order of keys: one formula, relative to the
/// first, so every cell that shares the node gets the same bits; in twice the precision where the seeds
/// nearly lie in a plane. Empty when they do.
std::optional<dvec3> circumcenter(const std::array<dvec3, 4>& seeds);

/// The nodes of a cell where every cell that shares them has them. Keeps buffers for reuse.
class CellNodes {
  public:
    /// Forgets the nodes of the last cell.
    void start(const VoronoiCell& cell);
    /// The node at a vertex whose three planes are those of seeds; `cell` is the one started with.
    dvec3 at(const VoronoiCell& cell, std::size_t vertex, const Seed& own, std::span<const Seed> sites);

  private:
    std::vector<dvec3> nodes_;
    std::vector<bool> known_;
};

/// Makes the beams that a cell owns: those of its edges whose two other seeds have higher keys than its own.
/// Not thread-safe; keeps buffers for reuse.
class BeamMaker {
  public:
    using Piece = Beam;
    /// Radii are asked for at the nodes as the stretch maps them.
    explicit BeamMaker(NodeRadius radius, const Stretch& stretch = {})
        : tapered_(std::move(radius)), stretch_(stretch) {}

    double largest_growth() const { return tapered_.radius().largest(); }
    double growth(const Box& box) const { return tapered_.radius().largest_in(box); }
    bool avoids(const Box& /*box*/) const { return false; }
    const Stretch& stretch() const { return stretch_; }

    /// Appends the beams that `own` owns, in the order of the other seeds' keys. The cell's identifiers index
    /// `sites`. Edges that reach the start box are left out. Only where the four seeds of a node tie with a
    /// fifth to within rounding, and lie in a plane, is the node taken from the cell. An edge that four or
    /// more cells share may then be made more than once, in one place. Returns the number of edges left out.
    std::size_t append(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
                       std::vector<Beam>& beams);
    /// Appends the beam along an edge between two nodes in the part's space.
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
