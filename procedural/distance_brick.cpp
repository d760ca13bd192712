// Building the short lists of a brick, and asking them.
#include "procedural/distance_brick.h"

#include <cmath>
#include <numeric>

#include "engine/error.h"

namespace lamella {
namespace {

constexpr double safe_side = 1 + 1e-9;

Box octant_of(const Box& box, int octant) {
    const dvec3 half = box.size() * 0.5;
    const dvec3 lo = box.lo + half * dvec3(octant & 1, (octant >> 1) & 1, octant >> 2);
    return {lo, lo + half};
}

}  // namespace

DistanceBrick::DistanceBrick(const Box& box, const Query& beams_touching) : box_(box) {
    // Beams that do not touch the grown cube are farther than the growth from all of it. Grow until every
    // voxel's list must be complete.
    const double first_growth = 0.75 * (box.hi.x - box.lo.x);
    for (double growth = first_growth;; growth *= 1.5) {
        const std::vector<Beam> near = beams_touching(grown(box, growth));
        if (near.size() > 65535) throw FaultError("more than 65535 beams are near one brick of the foam");
        std::vector<std::uint16_t> candidates(near.size());
        std::iota(candidates.begin(), candidates.end(), std::uint16_t{0});
        lists_.clear();
        begins_.assign(1, 0);
        if (!divide(box, candidates, near, growth, 0)) continue;
        keep_used(near);
        return;
    }
}

/// Narrows the candidates down from cube to octant. False when a beam beyond the growth might be nearest.
bool DistanceBrick::divide(const Box& box, std::span<const std::uint16_t> candidates,
                           const std::vector<Beam>& near, double growth, int depth) {
    const dvec3 center = box.center(), size = box.size();
    const double diagonal = std::sqrt(size.x * size.x + size.y * size.y + size.z * size.z) * safe_side;
    std::vector<double> distances(candidates.size());
    double nearest = infinity;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        distances[i] = signed_distance(near[candidates[i]], center);
        nearest = std::min(nearest, distances[i]);
    }
    std::vector<std::uint16_t> kept;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (distances[i] <= nearest + diagonal) kept.push_back(candidates[i]);
    }
    if (depth < halvings) {
        for (int octant = 0; octant < 8; ++octant) {
            if (!divide(octant_of(box, octant), kept, near, growth, depth + 1)) return false;
        }
        return true;
    }
    if (!(nearest + diagonal < growth)) return false;
    lists_.insert(lists_.end(), kept.begin(), kept.end());
    begins_.push_back(static_cast<std::uint32_t>(lists_.size()));
    return true;
}

/// Keeps the beams that stand on a list, and renumbers the lists.
void DistanceBrick::keep_used(const std::vector<Beam>& near) {
    std::vector<std::int32_t> renumbered(near.size(), -1);
    for (std::uint16_t& beam : lists_) {
        if (renumbered[beam] < 0) {
            renumbered[beam] = static_cast<std::int32_t>(beams_.size());
            beams_.push_back(near[beam]);
        }
        beam = static_cast<std::uint16_t>(renumbered[beam]);
    }
    beams_.shrink_to_fit();
    lists_.shrink_to_fit();
}

double DistanceBrick::distance(dvec3 p) const {
    const dvec3 voxel = glm::floor((p - box_.lo) / box_.size() * static_cast<double>(side));
    const glm::ivec3 at = glm::clamp(glm::ivec3(voxel), 0, side - 1);
    std::size_t v = 0;
    for (int bit = halvings - 1; bit >= 0; --bit) {
        const int octant = ((at.x >> bit) & 1) | ((at.y >> bit) & 1) << 1 | ((at.z >> bit) & 1) << 2;
        v = v * 8 + static_cast<std::size_t>(octant);
    }
    double nearest = infinity;
    for (std::uint32_t i = begins_[v]; i < begins_[v + 1]; ++i) {
        nearest = std::min(nearest, signed_distance(beams_[lists_[i]], p));
    }
    return nearest;
}

std::size_t DistanceBrick::bytes() const {
    return sizeof(DistanceBrick) + beams_.capacity() * sizeof(Beam) + lists_.capacity() * sizeof(lists_[0]) +
           begins_.capacity() * sizeof(begins_[0]);
}

}  // namespace lamella
