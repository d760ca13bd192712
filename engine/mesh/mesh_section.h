// MeshSection: the section of a closed mesh with a plane, as runs by winding number.
#pragma once

#include <vector>

#include "engine/mesh/triangle_tree.h"
#include "engine/runs/runs.h"
#include "engine/solids/plane_index.h"

namespace lamella {

/// The directed segments in which a closed chain of triangles meets a plane. A point is solid where the
/// section's winding number around it is not 0. This equals the mesh's winding number there, so nested
/// shells, overlaps and capped holes are handled correctly.
class MeshSection {
  public:
    /// `triangles`: all triangles that meet the plane at height z (mm), possibly more.
    MeshSection(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles, double z);

    void runs(const RowBand& band, RunRows& out) const;
    Rect bounds() const { return boxes_.bounds(); }
    const std::vector<SectionSegment>& segments() const { return segments_; }

  private:
    std::vector<SectionSegment> segments_;
    PlaneIndex boxes_;
};

}  // namespace lamella
