// A small cube of space that knows, for each of its voxels, the few beams that can be nearest there.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/beam.h"

namespace lamella {

/// Finds the exact distance to the nearest of infinitely many beams from a short list. A beam is on a voxel's
/// list when its distance from the voxel's centre exceeds the smallest one by no more than the voxel's
/// diagonal; distances are 1-Lipschitz, so no other beam is nearest anywhere in the voxel. Immutable.
class DistanceBrick {
  public:
    /// All beams that touch a box.
    using Query = std::function<std::vector<Beam>(const Box&)>;
    /// Gathers the beams about the cube `box`, mm.
    DistanceBrick(const Box& box, const Query& beams_touching);

    /// The signed distance to the union of all beams at a point of the cube, mm.
    double distance(dvec3 p) const;
    std::size_t bytes() const;
    Interval z_extent() const { return {box_.lo.z, box_.hi.z}; }

  private:
    static constexpr int halvings = 2;          // from the cube to a voxel
    static constexpr int side = 1 << halvings;  // voxels along an edge

    bool divide(const Box& box, std::span<const std::uint16_t> candidates, const std::vector<Beam>& near,
                double growth, int depth);
    void keep_used(const std::vector<Beam>& near);

    Box box_;
    std::vector<Beam> beams_;
    std::vector<std::uint32_t> begins_;  ///< by voxel, in the order of an octree
    std::vector<std::uint16_t> lists_;
};

}  // namespace lamella
