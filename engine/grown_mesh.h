// The triangles of a mesh grown by a ball: everything within a distance of the surface, in closed form.
#pragma once

#include <memory>
#include <vector>

#include "engine/beam_slice.h"
#include "engine/interval_index.h"
#include "engine/mesh_repair.h"

namespace lamella {

/// A mesh prepared for growing: face planes, and the edges whose grown capsule can reach where no prism does.
class GrownMesh {
  public:
    /// inside_only: the caller wants the part inside the solid only. Inside an oriented manifold, a convex
    /// edge's capsule lies within the prisms of its two triangles, so only reflex edges are kept. distance in
    /// mm, > 0.
    GrownMesh(std::shared_ptr<const SolidMesh> solid, double distance, bool inside_only);

    double distance() const { return distance_; }
    const TriangleMesh& mesh() const { return solid_->mesh; }

    /// Per triangle a prism, per kept edge a capsule: those that may meet the plane at height z, mm.
    void near_plane(double z, std::vector<std::uint32_t>& triangles, std::vector<Beam>& capsules) const;
    /// Adds the triangle's prism's runs in the plane at height z.
    void collect_prism(std::uint32_t triangle, double z, const RowBand& band, RunCollector& runs) const;

  private:
    std::shared_ptr<const SolidMesh> solid_;
    double distance_;
    std::vector<dvec3> normals_;  ///< unit, or 0 for a triangle without area
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;
    IntervalIndex triangles_by_height_, edges_by_height_;
};

/// The runs of a grown mesh in one plane.
class GrownMeshSlice : public SampledSlice {
  public:
    GrownMeshSlice(const Field& field, const GrownMesh& grown, double z);
    void spans(const RowBand& band, Scratch& scratch, SpanRows& out) const override;
    Rect bounds() const override { return unite(capsules_->bounds(), prisms_.bounds()); }

  private:
    const GrownMesh& grown_;
    double z_;
    std::vector<std::uint32_t> triangles_;
    std::unique_ptr<BeamRows> capsules_;
    PlaneIndex prisms_;
};

}  // namespace lamella
