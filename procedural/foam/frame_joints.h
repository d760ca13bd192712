// FrameJoints: beams that connect the parts of a surface frame where Voronoi faces and edges alone do not.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "engine/base/disjoint_sets.h"
#include "procedural/foam/cell_faces.h"
#include "procedural/foam/surface_curves.h"

namespace lamella {

/// Joins, cell by cell, components that are connected in the body but not in the frame.
///
/// In a cell, the frame consists of the curves on its faces and the parts of its edges inside the body. Where
/// the body is thin compared to the cell, a face may cut it in a loop that meets no edge, and a cell may
/// contain several such components. All components in one connected part of the intersection of cell and body
/// are joined. So foam and frame are connected wherever the body is, up to features smaller than the lattice
/// spacing. Components are joined by the straight line between their nearest points if that leaves the body
/// by less than a quarter of the frame's radius, else by a path through a lattice of 20 points along the
/// cell. Not thread-safe; keeps buffers for reuse.
class FrameJoints {
  public:
    /// `radius` is that of the frame. `edges_hold` tells whether the cells' edges are beams.
    FrameJoints(NodeRadius radius, bool edges_hold) : radius_(std::move(radius)), edges_hold_(edges_hold) {}

    /// Returns the joints of a cell, as lines. `curves` are those on all its faces. `own` and `sites` are
    /// those of the cell, in seed space.
    std::vector<SurfaceCurve> joints(std::span<const CellFaces::Face> faces,
                                     std::span<const SurfaceCurve> curves, SurfaceTracer& tracer,
                                     const Seed& own, std::span<const Seed> sites, const Stretch& stretch);

  private:
    /// A pair of components that could be joined, and the line or path between them.
    struct Candidate {
        double length;
        std::size_t a, b;
        SurfaceCurve path;
    };
    struct Lattice;

    std::uint32_t point(dvec3 p);
    void add_edges(std::span<const CellFaces::Face> faces, SurfaceTracer& tracer);
    void collect_components();
    void join(std::vector<Candidate>& candidates, std::vector<SurfaceCurve>& joints);
    bool leads_through(dvec3 p, dvec3 q, const Field& body, double allowance) const;
    std::vector<Candidate> straight(const Field& body) const;
    std::vector<Candidate> paths(std::span<const CellFaces::Face> faces, const Field& body, const Seed& own,
                                 std::span<const Seed> sites, const Stretch& stretch) const;
    SurfaceCurve shortened(const SurfaceCurve& path, const Field& body) const;

    NodeRadius radius_;
    bool edges_hold_;
    std::map<dvec3, std::uint32_t, PlaceOrder> points_;
    std::vector<dvec3> places_;
    DisjointSets connected_;  // of places_
    std::vector<std::vector<dvec3>> components_;
    std::vector<std::uint32_t> component_roots_;
};

}  // namespace lamella
