// SurfaceCharts: along which axis a body's surface is seen best, and how far the seams between are.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>

#include "engine/field/field.h"
#include "procedural/skin/surface_walk.h"
#include "procedural/voronoi/point_tree.h"

namespace lamella {

/// The two coordinate directions, six in all, that a surface may be projected along.
struct Chart {
    int axis = 0;          ///< 0 to 2
    bool positive = true;  ///< the side the outward normal points to
    friend bool operator==(const Chart&, const Chart&) = default;
};

/// Divides the space about a body's surface into charts: cubes where one axis is the nearest to the
/// direction in which the body's value rises. Cubes are halved, down to a stated size, where that axis
/// changes between their corners and middle. Of axes equally near, within 1 %, z comes before y before x, so
/// that a plane at 45 degrees has one chart. Immutable.
class SurfaceCharts {
  public:
    /// Cubes of `finest` mm at seams; wanted within `depth` mm of the surface. Throws InputError for a body
    /// without an extent or an end, or far too large for cubes of this size.
    SurfaceCharts(const Field& body, double finest, double depth);

    /// The chart at p; null away from the surface.
    std::optional<Chart> at(dvec3 p) const;
    /// At most the distance to the nearest place where charts meet, mm, and less than that by 0.71 of the
    /// finest cube at most; at most `limit`. Changes by at most 1 per mm.
    double seam_distance(dvec3 p, double limit) const;

  private:
    struct Key {
        int level;
        glm::i64vec3 index;
        friend bool operator==(const Key&, const Key&) = default;
    };
    struct Hash {
        std::size_t operator()(const Key& key) const;
    };

    Key key(dvec3 p, int level) const;
    void collect_seams(const LatticeCube& cube, Chart chart, std::vector<dvec3>& seams) const;

    double finest_;  ///< mm
    std::unordered_map<Key, Chart, Hash> leaves_;
    std::unique_ptr<const PointTree> seams_;  ///< middles of the finest faces between charts
};

}  // namespace lamella
