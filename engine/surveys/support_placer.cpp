// SupportPlacer: a hash grid of points.
#include "engine/surveys/support_placer.h"

namespace lamella {
namespace {

/// Returns a cell's key: 21 bits per coordinate. Distinct cells may share a key; the distance test tells
/// their points apart.
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

bool PointCells::any_below(dvec3 p) const {
    const dvec3 c = glm::floor(p / size_);
    for (int cell = 0; cell < 18; ++cell) {
        const auto found =
            cells_.find(cell_key(c.x + cell % 3 - 1, c.y + cell / 3 % 3 - 1, c.z - (cell / 9 % 2)));
        if (found == cells_.end()) continue;
        for (const dvec3 q : found->second) {
            const dvec3 d = q - p;
            if (d.z <= 0 && d.x * d.x + d.y * d.y + d.z * d.z <= size_ * size_) return true;
        }
    }
    return false;
}

SupportPlacer::SupportPlacer(double spacing, FieldPtr blocked)
    : blocked_(std::move(blocked)), placed_(spacing), missing_(spacing) {}

bool SupportPlacer::held(dvec3 p) const {
    if (placed_.any_below(p)) return true;
    return blocked(p) && missing_.any_below(p);
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
