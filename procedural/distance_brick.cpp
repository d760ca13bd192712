// Building the short lists of a brick, and asking them.
#include "procedural/distance_brick.h"

#include <cmath>

#include "engine/error.h"

namespace lamella {
namespace {

constexpr double safe_side = 1 + 1e-9;

}  // namespace

DistanceBrick::DistanceBrick(const Box& box, const Query& beams_touching) : box_(box) {
    const dvec3 voxel = box.size() / static_cast<double>(side);
    const double diagonal = std::sqrt(voxel.x * voxel.x + voxel.y * voxel.y + voxel.z * voxel.z) * safe_side;
    std::vector<double> distances;
    // Beams that do not touch the grown cube are farther than the growth from all of it. Grow until every
    // voxel's list must be complete.
    for (double growth = 2 * voxel.x;; growth *= 2) {
        const std::vector<Beam> near = beams_touching(grown(box, growth));
        beams_.clear();
        lists_.clear();
        std::vector<std::int32_t> renumbered(near.size(), -1);
        distances.resize(near.size());
        bool complete = true;
        for (int v = 0; v < side * side * side && complete; ++v) {
            const dvec3 place(v % side, (v / side) % side, v / (side * side));
            const dvec3 center = box.lo + (place + 0.5) * voxel;
            double nearest = infinity;
            for (std::size_t i = 0; i < near.size(); ++i) {
                distances[i] = signed_distance(near[i], center);
                nearest = std::min(nearest, distances[i]);
            }
            complete = nearest + diagonal < growth;
            for (std::size_t i = 0; complete && i < near.size(); ++i) {
                if (distances[i] > nearest + diagonal) continue;
                if (renumbered[i] < 0) {
                    renumbered[i] = static_cast<std::int32_t>(beams_.size());
                    beams_.push_back(near[i]);
                }
                lists_.push_back(static_cast<std::uint16_t>(renumbered[i]));
            }
            begins_[static_cast<std::size_t>(v) + 1] = static_cast<std::uint32_t>(lists_.size());
        }
        if (beams_.size() > 65535) throw FaultError("more than 65535 beams are near one brick of the foam");
        if (complete) break;
    }
    beams_.shrink_to_fit();
    lists_.shrink_to_fit();
}

double DistanceBrick::distance(dvec3 p) const {
    const dvec3 voxel = glm::floor((p - box_.lo) / box_.size() * static_cast<double>(side));
    const glm::ivec3 at = glm::clamp(glm::ivec3(voxel), 0, side - 1);
    const auto v = static_cast<std::size_t>((at.z * side + at.y) * side + at.x);
    double nearest = infinity;
    for (std::uint32_t i = begins_[v]; i < begins_[v + 1]; ++i) {
        nearest = std::min(nearest, signed_distance(beams_[lists_[i]], p));
    }
    return nearest;
}

std::size_t DistanceBrick::bytes() const {
    return sizeof(DistanceBrick) + beams_.capacity() * sizeof(Beam) + lists_.capacity() * sizeof(lists_[0]);
}

}  // namespace lamella
