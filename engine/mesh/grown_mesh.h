// GrownMesh: a mesh dilated by balls, with one radius or a radius per vertex, in closed form.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/mesh/mesh_repair.h"
#include "engine/runs/interval_index.h"
#include "engine/solids/beam_slice.h"
#include "engine/solids/wedge_rows.h"

namespace lamella {

class RoundTriangleTree;

/// A mesh prepared for dilation. Every triangle becomes a round triangle, drawn as its wedge and its edges'
/// beams; an edge is kept only if its beam can reach points that no wedge covers.
class GrownMesh {
  public:
    /// Dilates by a distance, mm, > 0. `inside_only`: the caller needs the part inside the solid only. Inside
    /// an oriented manifold, a convex edge's beam lies within the wedges of its two triangles, so only reflex
    /// edges are kept.
    GrownMesh(std::shared_ptr<const SolidMesh> solid, double distance, bool inside_only);
    /// Dilates by a radius at each vertex, mm, >= 0. `tree` is that of the same mesh and radii;
    /// `inside_only`: as above.
    ///
    /// Inside an oriented manifold, one inner wedge per triangle suffices, plus the beams of edges that are
    /// reflex or whose two inner wedges leave a gap between them. Proof: let x be the point of the surface
    /// whose ball contains p deepest. If x is off the edges, p is in the inner wedge of its triangle. If x is
    /// on an edge, p lies on the inner side between the two wedges. If x is a vertex with convex edges only,
    /// the normals p - x for which it is deepest are bounded by its edges' gaps. The segment from p to x
    /// stays inside the solid, unless some point of the surface is so near to x that its smaller radius makes
    /// p deeper there: where a radius exceeds another one by more than the distance between them, both sides
    /// and all edges are kept.
    GrownMesh(std::shared_ptr<const SolidMesh> solid, std::vector<double> radii,
              const RoundTriangleTree& tree, bool inside_only);

    const TriangleMesh& mesh() const { return solid_->mesh; }
    /// Return how many edges are kept, and for how many triangles both sides are.
    std::size_t kept_edges() const { return edges_.size(); }
    std::size_t whole_triangles() const { return whole_count_; }

    /// Returns the wedges and the kept edges' beams that may meet the plane at height z, mm.
    void near_plane(double z, std::vector<Wedge>& wedges, std::vector<Beam>& beams) const;

  private:
    double radius(std::uint32_t vertex) const { return radii_.empty() ? distance_ : radii_[vertex]; }
    RoundTriangle triangle(std::uint32_t number) const;
    void index_triangles();
    void find_whole_triangles(const RoundTriangleTree& tree);
    template <typename IsKept>
    void keep_edges(const IsKept& is_kept);

    std::shared_ptr<const SolidMesh> solid_;
    double distance_ = 0;
    std::vector<double> radii_;  ///< by vertex; empty: distance_ for all
    std::vector<bool> whole_;    ///< by triangle: both sides count; empty: for all triangles
    std::size_t whole_count_ = 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;
    IntervalIndex triangles_by_height_, edges_by_height_;
};

/// The runs of a dilated mesh in one plane.
class GrownMeshSlice : public SampledSlice {
  public:
    GrownMeshSlice(const Field& field, const GrownMesh& grown, double z);
    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override;
    Rect bounds() const override { return unite(beams_.bounds(), wedges_.bounds()); }

  private:
    WedgeRows wedges_;
    BeamRows beams_;
};

}  // namespace lamella
