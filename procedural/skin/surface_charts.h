// SurfaceCharts: divides a surface by the axis that it faces most, and measures distances to the seams.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "engine/field/field.h"
#include "procedural/skin/surface_walk.h"
#include "procedural/voronoi/point_tree.h"

namespace lamella {

/// One of the six directions along which a surface may be projected.
struct Chart {
    int axis = 0;          ///< 0 to 2
    bool positive = true;  ///< sign of the outward normal along the axis
    friend bool operator==(const Chart&, const Chart&) = default;
};

/// Divides the space around a body's surface into charts: cubes in which one axis is nearest to the gradient
/// of the body's value. Cubes are halved, down to a given size, where that axis differs between their corners
/// and centre. If axes are equally near, within 1 %, z takes precedence over y over x, so that a plane at 45
/// degrees has one chart. Immutable.
class SurfaceCharts {
  public:
    /// `finest` is the size of cubes at seams, mm; `depth` the distance from the surface within which charts
    /// are wanted, mm. Throws InputError for an empty or unbounded body, and for one far too large for cubes
    /// of this size.
    SurfaceCharts(const Field& body, double finest, double depth);

    static constexpr std::uint32_t none = 0xFFFFFFFF;
    /// Returns the number of the leaf that holds p; `none` away from the surface. `guess` may be any number;
    /// the leaf of a point nearby is quick to confirm.
    std::uint32_t leaf_at(dvec3 p, std::uint32_t guess = none) const;
    Chart chart(std::uint32_t leaf) const { return leaves_[leaf].chart; }
    /// Returns the chart at p; none away from the surface.
    std::optional<Chart> at(dvec3 p) const;
    /// Returns a lower bound of the distance from a point of a leaf to the nearest seam between charts, mm,
    /// at most `limit`. It is too low by at most 0.71 of the finest cube. 1-Lipschitz.
    double seam_distance(std::uint32_t leaf, dvec3 p, double limit) const;

  private:
    struct Key {
        int level;
        glm::i64vec3 index;
        friend bool operator==(const Key&, const Key&) = default;
    };
    struct Leaf {
        Key key;
        Chart chart;
        double clear = 0;  ///< distance within which no point of the leaf has a seam, mm
    };
    struct Hash {
        std::size_t operator()(const Key& key) const;
    };

    Key key(dvec3 p, int level) const;
    void collect_seams(const LatticeCube& cube, Chart chart, std::vector<dvec3>& seams) const;

    double finest_;  ///< mm
    std::vector<Leaf> leaves_;
    std::unordered_map<Key, std::uint32_t, Hash> numbers_;  ///< of the leaves
    std::unique_ptr<const PointTree> seams_;                ///< centres of the finest faces between charts
};

}  // namespace lamella
