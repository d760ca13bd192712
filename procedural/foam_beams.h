// From cells to beams: each Voronoi edge made once, with ends that every cell agrees on.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/beam.h"
#include "procedural/cell_search.h"

namespace lamella {

/// The radius of the foam's beams at a node, mm: asked at nodes only, so all beams of a node agree.
class NodeRadius {
  public:
    explicit NodeRadius(double radius) : radius_(radius) {}
    double at(dvec3) const { return radius_; }
    /// No node has a larger one.
    double largest() const { return radius_; }

  private:
    double radius_;
};

/// The point at equal distance from four seeds, which come in the order of keys: one formula, relative to the
/// first, so every cell that shares the node gets the same bits; in twice the precision where the seeds
/// nearly lie in a plane. Empty when they do.
std::optional<dvec3> circumcenter(const std::array<dvec3, 4>& seeds);

/// Makes the beams that a cell owns: those of its edges whose two other seeds have higher keys than its own.
/// Not thread-safe; keeps buffers for reuse.
class BeamMaker {
  public:
    /// Appends the beams that `own` owns, in the order of the other seeds' keys. The cell's identifiers index
    /// `sites`. Edges that reach the start box are left out. Only where the four seeds of a node tie with a
    /// fifth to within rounding, and lie in a plane, is the node taken from the cell. An edge that four or
    /// more cells share may then be made more than once, in one place. Returns the number of edges left out.
    std::size_t append(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
                       const NodeRadius& radius, std::vector<Beam>& beams);

  private:
    struct Edge {
        const Seed* second;
        const Seed* third;
        std::size_t from, to;
    };
    dvec3 node(const VoronoiCell& cell, std::size_t vertex, const Seed& own, std::span<const Seed> sites);

    std::vector<Edge> edges_;
    std::vector<dvec3> nodes_;
    std::vector<bool> known_;
};

}  // namespace lamella
