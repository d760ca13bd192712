// Cells of points, found by hashing.
#include "engine/support_placer.h"

namespace lamella {
namespace {

/// A cell's number: 21 bits a coordinate. Cells that share a number are told apart by the distance.
std::uint64_t cell_key(double x, double y, double z) {
    constexpr double half = 1 << 20;
    const auto bits = [](double v) {
        return static_cast<std::uint64_t>(std::min(std::max(v + half, 0.0), 2 * half - 1));
    };
    return bits(x) << 42U | bits(y) << 21U | bits(z);
}

}  // namespace

void PointCells::add(dvec3 p) {
    const dvec3 c = glm::floor(p / size_);
    cells_[cell_key(c.x, c.y, c.z)].push_back(p);
}

bool PointCells::any_below(dvec3 p, double distance) const { return any(p, distance, false); }
bool PointCells::any_near(dvec3 p, double distance) const { return any(p, distance, true); }

bool PointCells::any(dvec3 p, double distance, bool above) const {
    const dvec3 c = glm::floor(p / size_);
    for (int k = -1; k <= (above ? 1 : 0); ++k) {
        for (int j = -1; j <= 1; ++j) {
            for (int i = -1; i <= 1; ++i) {
                const auto found = cells_.find(cell_key(c.x + i, c.y + j, c.z + k));
                if (found == cells_.end()) continue;
                for (const dvec3 q : found->second) {
                    const dvec3 d = q - p;
                    if (!above && d.z > 0) continue;
                    if (d.x * d.x + d.y * d.y + d.z * d.z <= distance * distance) return true;
                }
            }
        }
    }
    return false;
}

SupportPlacer::SupportPlacer(double spacing, FieldPtr blocked)
    : spacing_(spacing), blocked_(std::move(blocked)), placed_(spacing), missing_(spacing) {}

bool SupportPlacer::held(dvec3 p) const {
    if (placed_.any_below(p, spacing_)) return true;
    return blocked(p) && missing_.any_below(p, spacing_);
}

bool SupportPlacer::place(dvec3 p, SupportReason reason) {
    if (blocked(p)) {
        ++left_out_;
        missing_.add(p);
        return false;
    }
    placed_.add(p);
    points_.push_back({p, reason});
    return true;
}

}  // namespace lamella
