// MeshRays: finds the triangles of a mesh straight above a point.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/mesh/mesh.h"

namespace lamella {

/// Counts a mesh's crossings with vertical rays. Triangles are binned over x and y. A half-open rule at edges
/// and corners decides which ones a ray meets, so over a closed mesh the signs sum to its winding number.
class MeshRays {
  public:
    explicit MeshRays(const TriangleMesh& mesh);

    /// Calls visit(triangle, sign) for the triangles above p; sign is +1 where the ray leaves the solid.
    template <class Visit>
    void each_above(dvec3 p, const Visit& visit) const {
        if (!box_.contains({p.x, p.y, box_.lo.z})) return;
        const std::size_t bin = column(p.x) + row(p.y) * bins_;
        for (std::uint32_t i = begin_[bin]; i < begin_[bin + 1]; ++i) {
            const std::uint32_t triangle = members_[i];
            if (const int sign = crossing(triangle, p); sign != 0) visit(triangle, sign);
        }
    }

  private:
    struct Bins {
        std::size_t x0, x1, y0, y1;
        std::size_t count() const { return (x1 - x0 + 1) * (y1 - y0 + 1); }
    };
    Bins bins_of(const std::array<std::uint32_t, 3>& t) const;
    std::size_t column(double x) const {
        return index((x - box_.lo.x) / std::max(box_.hi.x - box_.lo.x, tiny));
    }
    std::size_t row(double y) const { return index((y - box_.lo.y) / std::max(box_.hi.y - box_.lo.y, tiny)); }
    std::size_t index(double share) const {
        return std::min(bins_ - 1,
                        static_cast<std::size_t>(std::max(0.0, share) * static_cast<double>(bins_)));
    }
    int crossing(std::uint32_t triangle, dvec3 p) const;
    void fill();

    static constexpr double tiny = 1e-300;
    const TriangleMesh& mesh_;
    Box box_;
    std::size_t bins_ = 1;  // along x, and along y
    std::vector<std::uint32_t> begin_, members_;
};

}  // namespace lamella
