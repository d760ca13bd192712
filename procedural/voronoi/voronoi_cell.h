// One Voronoi cell, exact: a box clipped by the bisectors between its seed and others.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// A convex cell in its dual form: vertices are triples of planes, and the triples form a triangulated sphere
/// (as in Ray, Sokolov, Lefebvre, Levy, "Meshless Voronoi on the GPU", 2018, with links between triples
/// added). Coordinates are relative to the cell's seed. A new vertex is found on the edge that is cut,
/// between its ends, so vertices stay finite and inside the start box whatever the seeds. Memory grows with
/// the cell; an object is meant to be reused. A plane that only touches a vertex, to within 1e-12 of the
/// cell's size, does not cut: of seeds that tie, the first one clipped stays.
class VoronoiCell {
  public:
    /// Three planes by identifier, counter-clockwise seen from outside. The start box has the identifiers -6
    /// to -1.
    using Triple = std::array<std::int32_t, 3>;

    /// Begins anew with a cube of this half side about the seed, mm.
    void start(double half_side);
    /// Cuts off what is nearer to the seed at `offset` from this cell's seed. Returns whether anything was.
    bool clip(dvec3 offset, std::int32_t id);
    /// Whether a seed in the box (relative to this cell's seed) could still cut: exact up to rounding, which
    /// errs on the safe side. A box farther from every vertex than the vertex from the seed cannot.
    bool could_be_cut_from(const Box& box) const;
    /// The square of the largest distance from the seed to a vertex, mm^2. A seed twice as far cannot cut.
    double reach_squared() const { return reach_squared_; }
    /// The box about all balls that are centred at a vertex and pass through the seed: where seeds that could
    /// still cut must lie.
    Box region_of_influence() const;

    std::size_t vertex_count() const { return links_.size(); }
    dvec3 vertex(std::size_t v) const { return {x_[v], y_[v], z_[v]}; }
    Triple planes(std::size_t v) const;
    /// Calls visit(plane a, plane b, vertex v, vertex w) once for every edge; the edge lies on both planes.
    template <typename Visit>
    void edges(const Visit& visit) const {
        for (std::size_t v = 0; v < links_.size(); ++v) {
            for (std::size_t side = 0; side < 3; ++side) {
                const auto w = static_cast<std::size_t>(links_[v].across[side]);
                if (v < w) visit(id(v, side), id(v, (side + 1) % 3), v, w);
            }
        }
    }

  private:
    /// A dual triangle: slots of its planes, and the triangle across the side from corner i to i + 1.
    struct Link {
        std::array<std::int32_t, 3> plane;
        std::array<std::int32_t, 3> across;
    };
    /// A side of the hole that a cut leaves in the dual: a directed edge and the triangle outside.
    struct BorderEdge {
        std::int32_t from, to;
        std::int32_t outside;
        dvec3 vertex;
    };

    std::int32_t id(std::size_t v, std::size_t corner) const {
        return ids_[static_cast<std::size_t>(links_[v].plane[corner])];
    }
    bool border_of_cut(double tolerance);
    void replace_cut_vertices(std::int32_t plane);
    void move_vertex(std::int32_t from, std::int32_t to);
    void relink(std::int32_t triangle, std::int32_t from, std::int32_t to, std::int32_t neighbour);
    void resize(std::size_t vertices);
    void measure();

    std::vector<double> x_, y_, z_, excess_;
    std::vector<Link> links_;
    std::vector<std::int32_t> ids_;
    std::vector<std::int32_t> border_at_;  ///< by plane slot: the border edge that leaves it
    std::vector<std::int32_t> cut_;        ///< vertices beyond the plane
    std::vector<std::int32_t> slots_;      ///< where the new vertices go
    std::vector<BorderEdge> border_;
    double reach_squared_ = 0;
};

}  // namespace lamella
