// VoronoiCell: one exact Voronoi cell, a box clipped by the bisectors between its seed and other seeds.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// A convex cell in its dual form: each vertex is a triple of planes, and the triples form a triangulated
/// sphere (as in Ray, Sokolov, Lefebvre, Levy, "Meshless Voronoi on the GPU", 2018, with links between
/// triples added). Coordinates are relative to the cell's seed. A new vertex is found on the edge that is
/// cut, between its ends, so vertices stay finite and inside the start box whatever the seeds. Memory grows
/// with the cell, so reuse the object. A plane that only touches a vertex, to within 1e-12 of the cell's
/// size, does not cut: among tied seeds the first one clipped wins.
class VoronoiCell {
  public:
    /// The three planes of a vertex, counter-clockwise seen from outside, by identifier. The planes of the
    /// start box have the identifiers -6 to -1.
    using Triple = std::array<std::int32_t, 3>;

    /// Resets the cell to a cube of this half side around the seed, mm.
    void start(double half_side);
    /// Clips off the half-space that is nearer to another seed at `offset` (relative to this cell's seed,
    /// mm). Stores `id` as the plane's identifier. Returns whether anything was cut.
    bool clip(dvec3 offset, std::int32_t id);
    /// Returns whether a seed in the box (relative to this cell's seed) could still cut the cell.
    /// Conservative: rounding may only give a false positive. A box cannot cut if it is farther from every
    /// vertex than that vertex is from the seed.
    bool could_be_cut_from(const Box& box) const;
    /// The squared distance from the seed to its farthest vertex, mm^2. A seed more than twice that distance
    /// away cannot cut.
    double reach_squared() const { return reach_squared_; }
    /// Returns the bounding box of all balls that are centred at a vertex and pass through the seed. Seeds
    /// that can still cut lie in it.
    Box region_of_influence() const;

    std::size_t vertex_count() const { return links_.size(); }
    dvec3 vertex(std::size_t v) const { return {x_[v], y_[v], z_[v]}; }
    Triple planes(std::size_t v) const;
    /// Calls visit(plane a, plane b, vertex v, vertex w) once for every edge from v to w; the edge lies on
    /// both planes.
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
    /// A triangle of the dual: slots of its planes, and the neighbouring triangle across the side from corner
    /// i to i + 1.
    struct Link {
        std::array<std::int32_t, 3> plane;
        std::array<std::int32_t, 3> across;
    };
    /// A directed edge of the hole that a cut leaves in the dual, and the triangle outside.
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
    std::vector<std::int32_t> border_at_;  ///< by plane slot: the border edge that starts there
    std::vector<std::int32_t> cut_;        ///< vertices beyond the plane, ascending
    std::vector<std::int32_t> slots_;      ///< slots of the new vertices
    std::vector<BorderEdge> border_;
    double reach_squared_ = 0;
};

}  // namespace lamella
